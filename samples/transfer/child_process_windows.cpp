// See child_process.h.
#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "transfer/child_process.h"

namespace samples {
namespace {

// A word as the runtime of C takes it apart again: in quotes, with a backslash before quotes, and before backslashes
// that stand before a quote.
std::wstring quoted(const std::string& word) {
  std::wstring out = L"\"";
  size_t backslashes = 0;
  for (const wchar_t c : std::filesystem::u8path(word).wstring()) {
    if (c == L'"') out.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    out += c;
  }
  return out.append(backslashes, L'\\') + L"\"";
}

}  // namespace

int run_child(const std::vector<std::string>& words) {
  std::wstring line;
  for (const std::string& word : words) line += (line.empty() ? L"" : L" ") + quoted(word);
  STARTUPINFOW start = {};
  start.cb = sizeof start;
  PROCESS_INFORMATION child = {};
  if (!::CreateProcessW(nullptr, line.data(), nullptr, nullptr, FALSE, 0, nullptr, nullptr, &start, &child))
    throw std::runtime_error(
        words.front() + " cannot be started: " + std::system_category().message(static_cast<int>(::GetLastError())));
  ::CloseHandle(child.hThread);
  ::WaitForSingleObject(child.hProcess, INFINITE);
  DWORD code = 1;
  ::GetExitCodeProcess(child.hProcess, &code);
  ::CloseHandle(child.hProcess);
  return code > 128 ? 129 : static_cast<int>(code);  // crashes end with codes above 2^31
}

}  // namespace samples
#endif
