// The model of a solver, made from the headers alone. It holds the sites, and knows the code of every edit. The field
// is a dense solve of the saddle-point system
//     [ K  -W ] [   u    ]   [ 0 ]      W the places of the sites, D = 1 / (stiffness mean diagonal), 0 for hard ones
//     [ W'  D ] [ lambda ] = [ s ]
// The solve pivots and takes one step of refinement. Values are centred first, because K maps constants to 0.
#pragma once
#include <map>

#include "hf/solver.h"
#include "sequence_mesh.h"
#include "support/peers.h"

namespace sequences {

// Where a site is put: a vertex as given, or a point of a triangle as given.
struct Place {
  std::uint32_t vertex = HF_NO_INDEX;
  std::uint32_t triangle = HF_NO_INDEX;
  double weight[3] = {0, 0, 0};
};

struct Site {
  std::uint32_t given_vertex = HF_NO_INDEX;  // as hf_solver_get_sites says it
  int at_vertex = -1;                        // inner vertex, or -1 for a point inside a triangle
  std::vector<std::pair<int, double>> row;   // of W'
  int component = 0;
  double stiffness = 0;
  std::vector<double> values;
};

// One batch, as hf_edit_desc.
struct Edit {
  std::vector<std::uint32_t> remove, move, set;
  std::vector<Place> move_to, add;
  std::vector<double> set_values, add_values, add_stiffness;  // add_*: empty stands for NULL
};

struct Setting {
  const Surface* surface = nullptr;
  const Operator* operation = nullptr;
  int engine = ENGINE_GREEN;
  std::size_t channels = 1;
  std::size_t site_limit = 24;
};

class Model {
 public:
  explicit Model(const Setting& setting) : setting_(setting) {}

  using Sites = std::map<std::uint32_t, Site>;
  const Sites& sites() const { return sites_; }

  // The code the edit must get. On HF_OK the edit is done once the numbers of the new sites are known: see accept().
  hf_result judge(const Edit& edit);
  // Takes the judged edit over. False: a number of `added` is in use or comes twice.
  bool accept(const std::vector<std::uint32_t>& added);

  // u has a row per inner vertex, scale one per component, lambda one per site by ascending number; columns are
  // channels. The scale is the range of the values, or of a field that overshoots it. For equal values it is 1e-5 of
  // their size.
  struct Answer {
    Eigen::MatrixXd field, scale, lambda;
    std::vector<int> sites_of_component;
  };
  const Answer& answer();

 private:
  hf_result locate(const Place& place, Site& site) const;
  hf_result claim(const Sites& sites, const std::vector<Site>& more, const Site& site) const;
  bool dependent(const Sites& sites, const std::vector<Site>& more) const;
  void solve_component(int component);

  Setting setting_;
  Sites sites_, next_;
  std::vector<Site> added_;
  Answer answer_;
  bool known_ = false;
};

}  // namespace sequences
