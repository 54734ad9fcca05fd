#include "base/progress.h"

namespace hf_inner {
namespace {

thread_local Progress* progress_of_call = nullptr;

}  // namespace

CallProgress::CallProgress(Progress* progress) noexcept : outer_(progress_of_call) { progress_of_call = progress; }

CallProgress::~CallProgress() { progress_of_call = outer_; }

Progress* current_progress() noexcept { return progress_of_call; }

}  // namespace hf_inner
