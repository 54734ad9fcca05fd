// See batch.h.
#include "transfer/batch.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <thread>

#include "gltf/file_bytes.h"
#include "gltf/json_file.h"
#include "transfer/child_process.h"

namespace samples {

using namespace hf_gltf;
namespace fs = std::filesystem;
namespace {

// Longer lists and lines are a mistake, such as a model given in the list's place.
constexpr size_t most_lines = 1000000, longest_line = 65536;

std::vector<std::string> words_of(const std::string& line, const std::string& where) {
  std::vector<std::string> out;
  bool inside = false, open = false;  // a word; quotes
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (!open && (c == ' ' || c == '\t' || c == '\r')) {
      inside = false;
      continue;
    }
    if (!inside) {
      out.emplace_back();
      inside = true;
    }
    if (c == '"') {
      open = !open;
    } else if (c == '\\' && i + 1 < line.size() && (line[i + 1] == '"' || line[i + 1] == '\\')) {
      out.back() += line[++i];
    } else {
      out.back() += c;
    }
  }
  if (open) throw std::runtime_error(where + ": a quote is not closed");
  return out;
}

// A folder of its own for the reports, removed at the end.
class ReportFolder {
 public:
  ReportFolder() {
    std::random_device random;
    for (int tries = 0; tries < 100; ++tries) {
      path_ = fs::temp_directory_path() / ("hf_transfer_" + std::to_string(random()));
      if (fs::create_directory(path_)) return;
    }
    throw std::runtime_error("no folder for reports can be made in " + fs::temp_directory_path().string());
  }
  ~ReportFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

nlohmann::json run_line(const std::string& program, const BatchLine& line, const ReportFolder& reports) {
  const auto start = std::chrono::steady_clock::now();
  const fs::path own = reports / (std::to_string(line.number) + ".json");
  std::vector<std::string> words = {program, "--silent", "--outcome", own.u8string()};
  words.insert(words.end(), line.words.begin(), line.words.end());
  nlohmann::json out = {{"line", line.number}, {"exit", 1}};
  try {
    out["exit"] = run_child(words);
    const nlohmann::json said = fs::exists(own) ? JsonFile(own).root().value() : nlohmann::json::object();
    for (const auto& item : said.items()) out[item.key()] = item.value();
    if (out["exit"] != 0 && !out.contains("error")) out["error"] = "the process ended without a word";
  } catch (const std::exception& error) {
    out["error"] = error.what();
  }
  out["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace

std::vector<BatchLine> read_batch(const fs::path& list) {
  std::ifstream file(list, std::ios::binary);
  if (!file) throw std::runtime_error(list.string() + ": the list cannot be read");
  std::vector<BatchLine> out;
  std::string text;
  for (size_t number = 1; std::getline(file, text); ++number) {
    if (number == 1) text.erase(0, hf_gltf::text_begin(text, list.string()));
    const std::string where = list.filename().string() + ", line " + std::to_string(number);
    if (text.size() > longest_line || number > most_lines)
      throw std::runtime_error(where + ": a list has at most " + std::to_string(most_lines) + " lines of " +
                               std::to_string(longest_line) + " characters");
    std::vector<std::string> words = words_of(text, where);
    if (words.empty() || words.front().rfind('#', 0) == 0) continue;
    if (std::find(words.begin(), words.end(), "--batch") != words.end())
      throw std::runtime_error(where + ": a list cannot contain --batch");
    out.push_back({number, std::move(words)});
  }
  if (out.empty()) throw std::runtime_error(list.string() + ": the list has no line");
  return out;
}

int run_batch(const std::string& program, const std::vector<BatchLine>& lines, unsigned jobs) {
  if (jobs == 0) jobs = std::max(1u, std::thread::hardware_concurrency());
  const ReportFolder reports;
  std::atomic<size_t> next{0};
  std::mutex printing;
  int worst = 0;
  const auto work = [&] {
    for (size_t i = next++; i < lines.size(); i = next++) {
      const nlohmann::json said = run_line(program, lines[i], reports);
      const std::lock_guard<std::mutex> lock(printing);
      worst = std::max(worst, said["exit"].get<int>());
      std::printf("%s\n", said.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
      std::fflush(stdout);
    }
  };
  std::vector<std::thread> threads;
  for (size_t k = 1; k < std::min<size_t>(jobs, lines.size()); ++k) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  return worst;
}

}  // namespace samples
