// What is promised of a noun under a change, and what was measured.
#pragma once
#include <string>
#include <vector>

#include "setting.h"

namespace invariance {

// A cell of the table that is not held to the tolerance of its noun. It is so by design, or until a fault is mended.
struct Exception {
  const char* change;  // nullptr: every change but other forms of the same arrays
  const char* noun;    // nullptr: every noun
  double tolerance;    // infinity: it may differ by anything
  const char* reason;
  bool until = false;  // a fault that is being mended: the reason begins with its row
  bool skip = false;   // not even measured
};
const std::vector<Exception>& exceptions();

// The tolerance of a cell; `why` names an exception, or is null.
double tolerance_of(const Change& change, const Noun& noun, const Exception** why);

struct Cell {
  double worst = -1;    // below 0: no body has this cell
  std::string where;    // the body and the row that is off most
  std::string refused;  // a body whose copy was refused, with the sentence
  int bodies = 0;
};

using Table = std::vector<std::vector<Cell>>;  // by noun and change

// Prints cells that miss; returns their number.
int judge(const Table& table);
// Writes the table as the page docs/invariance.md.
void write_page(const Table& table, const std::vector<Body>& bodies, const std::string& file);

}  // namespace invariance
