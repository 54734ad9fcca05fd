// The table as a page: nouns down, changes across.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "table.h"

namespace invariance {
namespace {

std::string number(double value) {
  if (value == 0) return "0";
  if (std::isinf(value)) return "other";
  char text[32];
  std::snprintf(text, sizeof(text), value >= 0.01 ? "%.2g" : "%.0e", value);
  std::string out = text;
  // 2e-05 as 2e-5
  const std::size_t zero = out.find("e-0");
  if (zero != std::string::npos) out.erase(zero + 2, 1);
  return out;
}

// The difference, and behind it a mark of the exception that the cell has.
std::string cell_text(const Cell& cell, const Change& change, const Noun& noun) {
  const Exception* why = nullptr;
  const double tolerance = tolerance_of(change, noun, &why);
  if (cell.bodies == 0) return why != nullptr && why->skip ? "(" + std::string(why->reason).substr(0, 2) + ")" : "";
  if (!cell.refused.empty() && cell.worst < 0) return "refused";
  std::string out = number(cell.worst);
  if (why == nullptr) return cell.worst <= tolerance ? out : "**" + out + "**";
  if (cell.refused.empty() && cell.worst <= noun.tolerance) return out;
  const std::string reason = why->reason;
  return out + " " + (why->until ? reason.substr(0, reason.find(':')) : "d");
}

void write_lists(std::ofstream& out, const std::vector<Body>& bodies) {
  out << "## Changes\n\n| change | what it is |\n|---|---|\n";
  for (const Change& change : changes()) out << "| " << change.name << " | " << change.what << " |\n";
  out << "\n## Nouns\n\n| noun | what is compared | tolerance | why |\n|---|---|---|---|\n";
  for (const Noun& noun : nouns())
    out << "| " << noun.name << " | " << noun.what << " | " << number(noun.tolerance) << " | " << noun.reason << " |\n";
  out << "\n## What differs by design\n\n| change | noun | at most | reason |\n|---|---|---|---|\n";
  for (const Exception& e : exceptions()) {
    if (e.until) continue;
    out << "| " << (e.change != nullptr ? e.change : "every one but forms of the arrays") << " | "
        << (e.noun != nullptr ? e.noun : "every noun") << " | "
        << (std::isinf(e.tolerance) ? "any" : number(e.tolerance)) << " | " << e.reason << " |\n";
  }
  bool heading = false;
  for (const Exception& e : exceptions()) {
    if (!e.until) continue;
    if (!heading) out << "\n## Faults that are being mended\n\n| change | noun | fault |\n|---|---|---|\n";
    heading = true;
    out << "| " << (e.change != nullptr ? e.change : "every change") << " | "
        << (e.noun != nullptr ? e.noun : "every noun") << " | " << e.reason << (e.skip ? "; not measured" : "")
        << " |\n";
  }
  out << "\n## Bodies\n\n";
  for (std::size_t i = 0; i < bodies.size(); ++i)
    out << (i == 0 ? "" : ", ") << bodies[i].name << " (" << bodies[i].vertex_count() << ")";
  out << ".\n";
}

}  // namespace

void write_page(const Table& table, const std::vector<Body>& bodies, const std::string& file) {
  std::ofstream out(file);
  if (!out) throw std::runtime_error("cannot write " + file);
  out << "# What changes nothing\n\n"
         "A vertex in no triangle, another order of the vertices and another unit give the same result. "
         "`tests/invariance` gives every noun\nof the library sound bodies and changed copies of them. It takes the "
         "results back to the body and compares. `build/dev/bin/invariance --full --page docs/invariance.md`\nwrites "
         "this page; `ctest -R invariance` runs a quick form, and `tests/run --full` all bodies.\n\n"
         "A cell is the largest difference over "
      << bodies.size()
      << " bodies. Lengths count in box diagonals, fields in the range of their sites. 0: the same bits. d: it differs "
         "by design, see below.\nBold: a miss.\n\n";
  out << "|";
  for (const Change& change : changes()) out << " | " << change.name;
  out << " |\n|---";
  for (std::size_t c = 0; c < changes().size(); ++c) out << "|---";
  out << "|\n";
  for (std::size_t n = 0; n < nouns().size(); ++n) {
    out << "| " << nouns()[n].name;
    for (std::size_t c = 0; c < changes().size(); ++c) out << " | " << cell_text(table[n][c], changes()[c], nouns()[n]);
    out << " |\n";
  }
  out << "\n";
  write_lists(out, bodies);
}

}  // namespace invariance
