// Runs another program and waits for it.
#ifndef HF_SAMPLES_TRANSFER_CHILD_PROCESS_H
#define HF_SAMPLES_TRANSFER_CHILD_PROCESS_H

#include <string>
#include <vector>

namespace samples {

// Runs words[0], searched like a shell does, with the other words as they are. Returns its exit code; above 128 if the
// system ended it. Throws std::runtime_error if it cannot be started. Several threads may call it at once.
int run_child(const std::vector<std::string>& words);

}  // namespace samples

#endif
