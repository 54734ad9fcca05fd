// invariance [--full] [--body NAME] [--file MODEL] [--change NAME] [--noun NAME] [--page FILE] [--threads N] [--all]
//            [--unskip]
//
// Gives every noun of the library each body of the corpus and its changed copies, and compares what comes out.
// Prints the worst difference of every change and noun. --file takes one model in place of the corpus. --page writes
// docs/invariance.md. --threads works on N bodies at a time. --all prints every cell, --unskip measures cells that are
// left out while a fault is mended. The exit code is 1 if a cell misses its tolerance.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include "reliability/report.h"
#include "table.h"

namespace invariance {
namespace {

struct Options {
  bool full = false, all = false, unskip = false;
  int threads = 1;
  std::string body, file, change, noun, page;
};

bool wanted(const std::string& filter, const std::string& name) { return filter.empty() || filter == name; }

// What a noun measured, or the sentence with which it was refused.
struct Outcome {
  Measured measured;
  std::string refused;
};

Outcome measure(const Noun& noun, const Setting* setting, const std::string& unmade) {
  Outcome out;
  if (setting == nullptr) {
    out.refused = unmade;
    return out;
  }
  try {
    out.measured = noun.measure(*setting);
  } catch (const Refused& refused) {
    out.refused = refused.what();
  }
  return out;
}

// The surface of a copy, or null and the sentence of the refusal.
std::unique_ptr<Setting> set_up(const Body& body, const Copy& copy, std::string& refused) {
  try {
    return std::make_unique<Setting>(body, copy);
  } catch (const Refused& e) {
    refused = e.what();
    return nullptr;
  }
}

void compare(const Body& body, const Options& options, Table& table) {
  std::string refused;
  const Copy plain = plain_copy(body);
  const std::unique_ptr<Setting> base = set_up(body, plain, refused);
  std::vector<Outcome> base_outcomes(nouns().size());
  for (std::size_t n = 0; n < nouns().size(); ++n) {
    if (!wanted(options.noun, nouns()[n].name)) continue;
    base_outcomes[n] = measure(nouns()[n], base.get(), refused);
    if (options.all && !base_outcomes[n].refused.empty())
      std::printf("%s, %s: left out, %s\n", body.name.c_str(), nouns()[n].name, base_outcomes[n].refused.c_str());
  }
  for (std::size_t c = 0; c < changes().size(); ++c) {
    if (!wanted(options.change, changes()[c].name)) continue;
    const Copy copy = changes()[c].make(body);
    if (copy.points.empty()) continue;
    Copy indexed = copy;
    index_copy(body, indexed);
    const std::unique_ptr<Setting> setting = set_up(body, indexed, refused);
    for (std::size_t n = 0; n < nouns().size(); ++n) {
      if (!wanted(options.noun, nouns()[n].name) || !base_outcomes[n].refused.empty()) continue;
      const Exception* why = nullptr;
      tolerance_of(changes()[c], nouns()[n], &why);
      if (why != nullptr && why->skip && !options.unskip) continue;
      const Outcome outcome = measure(nouns()[n], setting.get(), refused);
      Cell& cell = table[n][c];
      ++cell.bodies;
      if (!outcome.refused.empty()) {
        cell.refused = body.name + ": " + outcome.refused;
        if (options.all) std::printf("%s, %s, %s: refused\n", body.name.c_str(), changes()[c].name, nouns()[n].name);
        continue;
      }
      std::string where;
      const double here = difference(base_outcomes[n].measured, outcome.measured, where);
      if (options.all)
        std::printf("%s, %s, %s: %.2g %s\n", body.name.c_str(), changes()[c].name, nouns()[n].name, here,
                    where.c_str());
      if (options.all) std::fflush(stdout);
      if (here <= cell.worst) continue;
      cell.worst = here;
      cell.where = body.name + ", " + where;
    }
  }
}

void merge(const Table& part, Table& table) {
  for (std::size_t n = 0; n < table.size(); ++n) {
    for (std::size_t c = 0; c < table[n].size(); ++c) {
      const Cell& from = part[n][c];
      Cell& to = table[n][c];
      to.bodies += from.bodies;
      if (!from.refused.empty()) to.refused = from.refused;
      if (from.worst <= to.worst) continue;
      to.worst = from.worst;
      to.where = from.where;
    }
  }
}

Table empty_table() { return Table(nouns().size(), std::vector<Cell>(changes().size())); }

// Every body has a table of its own; they are merged in the order of the bodies.
Table compare_all(const std::vector<Body>& bodies, const Options& options) {
  std::vector<Table> parts(bodies.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t b = next++; b < bodies.size(); b = next++) {
      const Body& body = bodies[b];
      parts[b] = empty_table();
      if (!wanted(options.body, body.name)) continue;
      const auto start = std::chrono::steady_clock::now();
      compare(body, options, parts[b]);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      std::printf("%s: %u vertices, %u pieces, %.1f s\n", body.name.c_str(), body.vertex_count(), body.piece_count,
                  seconds);
      std::fflush(stdout);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < options.threads; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  Table table = empty_table();
  for (const Table& part : parts) merge(part, table);
  return table;
}

int run(const Options& options) {
  const std::vector<Body> bodies =
      options.file.empty() ? corpus(options.full) : std::vector<Body>{body_of_file(options.file)};
  const Table table = compare_all(bodies, options);
  if (!options.page.empty()) write_page(table, bodies, options.page);
  const int misses = judge(table);
  report_at_least("invariance_bodies", static_cast<double>(bodies.size()), options.file.empty() ? 4 : 1);
  report_at_most("invariance_cells_missed", misses, 0);
  return report_status();
}

}  // namespace
}  // namespace invariance

int main(int argc, char** argv) {
  invariance::Options options;
  options.full = report_full(argc, argv) != 0;
  for (int i = 1; i < argc; ++i) {
    const auto value = [&](const char* name, std::string& to) {
      if (std::strcmp(argv[i], name) == 0 && i + 1 < argc) to = argv[++i];
    };
    if (std::strcmp(argv[i], "--all") == 0) options.all = true;
    if (std::strcmp(argv[i], "--unskip") == 0) options.unskip = true;
    value("--body", options.body);
    if (i < argc) value("--file", options.file);
    if (i < argc) value("--change", options.change);
    if (i < argc) value("--noun", options.noun);
    if (i < argc) value("--page", options.page);
    std::string threads;
    if (i < argc) value("--threads", threads);
    if (!threads.empty()) options.threads = std::atoi(threads.c_str());
  }
  return invariance::run(options);
}
