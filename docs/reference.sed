# The headers as Doxygen reads them: comments become documentation, behind code as well as above it. Headings stay comments.
1s|^/\* \(hf/[a-z]*\.h\) - |/** \\file \1\n * |
1s|^// \(hf/[a-z]*\.hpp\) - |/// \\file \1\n/// |
/^\/\* --/b
s|^\( *\)/\* |\1/** |
s|\([^ ] *\)/\* |\1/**< |
s|^\( *\)// |\1/// |
