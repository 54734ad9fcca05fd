// Holds the headers that programs of tests have precompiled (tests/CMakeLists.txt).
int main() { return 0; }
