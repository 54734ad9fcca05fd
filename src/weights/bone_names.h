// Reads the names of bones: one line for each, in words.
#pragma once
#include <cstring>

#include "base/index.h"
#include "base/memory.h"
#include "base/span.h"

namespace hf_inner::weights {

using BoneName = Span<const char>;

// By hand: the functions of <cctype> depend on the locale of the host.
inline bool is_upper(char c) noexcept { return c >= 'A' && c <= 'Z'; }
inline bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
inline char lower(char c) noexcept { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }
// Bytes of other alphabets count as letters.
inline bool is_letter(char c) noexcept {
  const char l = lower(c);
  return (l >= 'a' && l <= 'z') || static_cast<unsigned char>(c) >= 0x80;
}

// The lines of a text. The last one may end without a newline.
inline Vector<BoneName> split_names(Span<const char> text, Memory& memory) {
  Vector<BoneName> out(&memory);
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin;
    while (end < text.size() && text[end] != '\n') ++end;
    const std::size_t length = end > begin && text[end - 1] == '\r' ? end - begin - 1 : end - begin;
    out.push_back({text.data() + begin, length});
    begin = end + 1;
  }
  return out;
}

// Calls word(begin, end) for the words of a name. A word ends at a character that is no letter and no digit, between
// letters and digits, and before a capital. The name upperArm_L2 has upper, Arm, L and 2. In IKPole the words are IK
// and Pole.
template <class Word>
void for_words(const BoneName& name, Word&& word) {
  const auto kind = [&](std::size_t i) { return is_digit(name[i]) ? 1 : is_letter(name[i]) ? 2 : 0; };
  for (std::size_t begin = 0; begin < name.size();) {
    if (kind(begin) == 0) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    while (end < name.size() && kind(end) == kind(begin)) {
      const bool next_small = end + 1 < name.size() && kind(end + 1) == 2 && !is_upper(name[end + 1]);
      if (is_upper(name[end]) && (!is_upper(name[end - 1]) || next_small)) break;
      ++end;
    }
    word(begin, end);
    begin = end;
  }
}

// Whether the letters from begin to end are this word, which is in small letters.
inline bool is_word(const BoneName& name, std::size_t begin, std::size_t end, const char* word) noexcept {
  if (std::strlen(word) != end - begin) return false;
  for (std::size_t i = begin; i < end; ++i) {
    if (lower(name[i]) != word[i - begin]) return false;
  }
  return true;
}

}  // namespace hf_inner::weights
