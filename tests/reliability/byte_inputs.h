// Inputs of players of bytes: random ones, kept ones, and the smallest part of one that still fails.
#pragma once
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace play {

using Input = std::vector<std::uint8_t>;

inline std::string hex_of(const Input& input) {
  std::string text;
  char digits[3];
  for (const std::uint8_t b : input) {
    std::snprintf(digits, sizeof digits, "%02x", b);
    text += digits;
  }
  return text;
}

inline Input bytes_of(const std::string& hex) {
  Input input;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    input.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  return input;
}

// Every input that ever failed: a line of hex each.
inline void append_kept(const char* path, std::vector<Input>& inputs) {
  std::ifstream kept(path);
  for (std::string line; std::getline(kept, line);) {
    if (!line.empty() && line[0] != '#') inputs.push_back(bytes_of(line));
  }
}

// What a player is asked to play: kept inputs, inputs of --hex, then `count` random ones from number `first` on.
struct Arguments {
  std::vector<Input> given;
  std::uint64_t count, first = 0;

  Arguments(int argc, char** argv, std::uint64_t usual, const char* kept) : count(usual) {
    for (int i = 1; i + 1 < argc; ++i) {
      const std::string option = argv[i];
      if (option == "--count") count = std::stoull(argv[i + 1]);
      if (option == "--first") first = std::stoull(argv[i + 1]);
      if (option == "--hex") {
        given.push_back(bytes_of(argv[i + 1]));
        count = 0;
      }
    }
    append_kept(kept, given);
  }
};

// Input number i, of 8 to 67 bytes.
inline Input random_input(std::uint64_t i) {
  std::mt19937_64 random(i * 0x9E3779B97F4A7C15u + 1);
  Input input(8 + random() % 60);
  for (std::uint8_t& b : input) b = static_cast<std::uint8_t>(random() >> 32);
  return input;
}

// Removes and zeroes the bytes that the failure does not need.
template <class Passes>
Input smaller(Input input, Passes&& passes) {
  for (std::size_t piece = input.size() / 2; piece > 0; piece /= 2) {
    for (std::size_t at = 0; at + piece <= input.size();) {
      Input less = input;
      less.erase(less.begin() + static_cast<std::ptrdiff_t>(at),
                 less.begin() + static_cast<std::ptrdiff_t>(at + piece));
      if (passes(less))
        at += piece;
      else
        input = less;
    }
  }
  for (std::uint8_t& b : input) {
    const std::uint8_t before = std::exchange(b, std::uint8_t{0});
    if (passes(input)) b = before;
  }
  return input;
}

}  // namespace play
