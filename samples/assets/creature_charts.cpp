// Labels, boundaries, embedding, packing; see creature_charts.h.
#include "creature_charts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

namespace samples {
namespace {

using glm::dvec2;

constexpr uint32_t none = 0xFFFFFFFFu;

// Neighbour across every half-edge 3 t + k (corner k to the next).
std::vector<uint32_t> twins(const TriangleMesh& mesh) {
  std::vector<uint32_t> twin(3 * mesh.triangles.size(), none);
  std::unordered_map<uint64_t, uint32_t> open;
  open.reserve(twin.size());
  for (uint32_t h = 0; h < twin.size(); ++h) {
    const Triangle& t = mesh.triangles[h / 3];
    open.emplace(uint64_t(t[h % 3]) << 32 | t[(h + 1) % 3], h);
  }
  for (uint32_t h = 0; h < twin.size(); ++h) {
    const Triangle& t = mesh.triangles[h / 3];
    const auto other = open.find(uint64_t(t[(h + 1) % 3]) << 32 | t[h % 3]);
    if (other != open.end()) twin[h] = other->second;
  }
  return twin;
}

dvec3 nearest_on_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 d = b - a;
  const double length2 = dot(d, d);
  return a + (length2 > 0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0.0) * d;
}

// Which side of its bones a point lies on.
bool right_side(const Design& design, const ChartGroup& group, const dvec3& p) {
  dvec3 nearest(0);
  double best = 1e300;
  const auto offer = [&](const dvec3& q) {
    if (dot(p - q, p - q) < best) {
      best = dot(p - q, p - q);
      nearest = q;
    }
  };
  // the first joint tells the plane of the group: shoulder blades do not split the trunk's middle
  const double plane = design.rest[group.joints.front()].x;
  for (uint32_t j : group.joints) {
    if (plane == 0 && design.rest[j].x != 0) continue;
    offer(design.rest[j]);
    const int32_t parent = design.joints[j].parent;
    const bool inside = std::find(group.joints.begin(), group.joints.end(), uint32_t(parent)) != group.joints.end();
    if (inside) offer(nearest_on_segment(p, design.rest[size_t(parent)], design.rest[j]));
  }
  return dot(p - nearest, group.axis) < 0;
}

std::vector<uint32_t> label_triangles(const Design& design, const TriangleMesh& mesh,
                                      const std::vector<uint32_t>& twin) {
  std::vector<uint32_t> group_of(design.joints.size(), none);
  for (uint32_t g = 0; g < design.groups.size(); ++g) {
    for (uint32_t j : design.groups[g].joints) group_of[j] = g;
  }
  std::vector<uint32_t> label(mesh.triangles.size());
  for (size_t t = 0; t < label.size(); ++t) {
    const Triangle& v = mesh.triangles[t];
    const dvec3 p = (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]) / 3.0;
    const uint32_t joint = design.body.nearest_joint(p), group = group_of[joint];
    if (group == none) throw std::runtime_error("joint " + design.joints[joint].name + " is in no chart group");
    label[t] = 2 * group + right_side(design, design.groups[group], p);
  }
  // a triangle with two neighbours of one other label follows them
  for (int round = 0; round < 4; ++round) {
    for (uint32_t t = 0; t < label.size(); ++t) {
      const uint32_t a = label[twin[3 * t] / 3], b = label[twin[3 * t + 1] / 3], c = label[twin[3 * t + 2] / 3];
      if (a == b || a == c) {
        label[t] = a;
      } else if (b == c) {
        label[t] = b;
      }
    }
  }
  return label;
}

// Connected triangles of one label; small islands join the neighbour they share most edges with.
std::vector<uint32_t> charts_of_labels(const std::vector<uint32_t>& twin, std::vector<uint32_t>& label,
                                       uint32_t& chart_count) {
  const uint32_t count = static_cast<uint32_t>(label.size());
  const size_t least = std::max<size_t>(6, count / 800);
  std::vector<uint32_t> chart;
  for (int round = 0; round < 10; ++round) {
    chart.assign(count, none);
    chart_count = 0;
    bool merged = false;
    for (uint32_t seed = 0; seed < count; ++seed) {
      if (chart[seed] != none) continue;
      std::vector<uint32_t> members{seed};
      chart[seed] = chart_count;
      std::map<uint32_t, uint32_t> border;
      for (size_t i = 0; i < members.size(); ++i) {
        for (uint32_t k = 0; k < 3; ++k) {
          const uint32_t other = twin[3 * members[i] + k] / 3;
          if (label[other] != label[seed]) {
            ++border[label[other]];
          } else if (chart[other] == none) {
            chart[other] = chart_count;
            members.push_back(other);
          }
        }
      }
      ++chart_count;
      if (members.size() >= least || border.empty()) continue;
      const auto most = std::max_element(border.begin(), border.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      for (uint32_t t : members) label[t] = most->first;
      merged = true;
    }
    if (!merged) break;
  }
  return chart;
}

// One flat point per fan of triangles of one chart around a surface vertex.
ChartMesh cut_along_charts(const TriangleMesh& mesh, const std::vector<uint32_t>& twin,
                           const std::vector<uint32_t>& chart) {
  std::vector<uint32_t> parent(3 * mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  for (uint32_t h = 0; h < twin.size(); ++h) {
    const uint32_t g = twin[h];
    if (chart[h / 3] != chart[g / 3]) continue;
    // the start of h is the end of g
    const uint32_t a = root(h), b = root(g - g % 3 + (g + 1) % 3);
    parent[std::max(a, b)] = std::min(a, b);
  }
  ChartMesh cut;
  std::vector<uint32_t> name(parent.size(), none);
  cut.flat.triangles.resize(mesh.triangles.size());
  for (uint32_t c = 0; c < parent.size(); ++c) {
    uint32_t& known = name[root(c)];
    if (known == none) {
      known = static_cast<uint32_t>(cut.surface.size());
      cut.surface.push_back(mesh.triangles[c / 3][c % 3]);
    }
    cut.flat.triangles[c / 3][c % 3] = known;
  }
  cut.flat.points.resize(cut.surface.size());
  return cut;
}

// Border loops of every chart, in flat points.
std::vector<std::vector<uint32_t>> border_loops(const ChartMesh& cut, const std::vector<uint32_t>& twin,
                                                const std::vector<uint32_t>& chart) {
  std::vector<uint32_t> following(cut.flat.points.size(), none);
  for (uint32_t h = 0; h < twin.size(); ++h) {
    if (chart[h / 3] == chart[twin[h] / 3]) continue;
    following[cut.flat.triangles[h / 3][h % 3]] = cut.flat.triangles[h / 3][(h + 1) % 3];
  }
  std::vector<std::vector<uint32_t>> loops;
  std::vector<bool> seen(following.size(), false);
  for (uint32_t v = 0; v < following.size(); ++v) {
    if (following[v] == none || seen[v]) continue;
    loops.emplace_back();
    for (uint32_t w = v; w != none && !seen[w]; w = following[w]) {
      seen[w] = true;
      loops.back().push_back(w);
    }
  }
  return loops;
}

double signed_area(const std::vector<uint32_t>& loop, const std::vector<dvec3>& points) {
  double sum = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const dvec3 &a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

// Spreads the inside of all charts at once: over-relaxed Gauss-Seidel on the mean value equations.
void embed(const TriangleMesh& mesh, ChartMesh& cut, const std::vector<std::vector<uint32_t>>& holes,
           std::vector<bool> fixed) {
  struct Link {
    uint32_t to;
    double weight;
  };
  std::vector<std::vector<Link>> links(cut.flat.points.size());
  for (size_t t = 0; t < cut.flat.triangles.size(); ++t) {
    const Triangle& f = cut.flat.triangles[t];
    const Triangle& s = mesh.triangles[t];
    for (size_t k = 0; k < 3; ++k) {
      const dvec3 a = mesh.points[s[(k + 1) % 3]] - mesh.points[s[k]],
                  b = mesh.points[s[(k + 2) % 3]] - mesh.points[s[k]];
      const double half = std::tan(0.5 * std::atan2(length(cross(a, b)), dot(a, b)));
      links[f[k]].push_back({f[(k + 1) % 3], half / std::max(length(a), 1e-12)});
      links[f[k]].push_back({f[(k + 2) % 3], half / std::max(length(b), 1e-12)});
    }
  }
  for (const std::vector<uint32_t>& hole : holes) {
    const uint32_t bridge = static_cast<uint32_t>(cut.flat.points.size());
    dvec3 centre(0);
    links.emplace_back();
    for (uint32_t v : hole) {
      double total = 0;
      for (const Link& link : links[v]) total += link.weight;
      links[v].push_back({bridge, total / double(links[v].size())});
      links[bridge].push_back({v, 1.0});
      centre += cut.flat.points[v] / double(hole.size());
    }
    cut.flat.points.push_back(centre);
    fixed.push_back(false);
  }
  const double over = 1.75;
  for (int round = 0; round < 150; ++round) {
    for (size_t v = 0; v < links.size(); ++v) {
      if (fixed[v] || links[v].empty()) continue;
      dvec3 sum(0);
      double total = 0;
      for (const Link& link : links[v]) {
        sum += link.weight * cut.flat.points[link.to];
        total += link.weight;
      }
      cut.flat.points[v] += (round < 145 ? over : 1.0) * (sum / total - cut.flat.points[v]);
    }
  }
  cut.flat.points.resize(cut.surface.size());
}

// Where the outline of a side view folds over itself, lets it give way: corners of turned triangles move to the mean of
// their neighbours. Every chart keeps the state with the fewest turned triangles it has seen.
void unfold(ChartMesh& cut, const std::vector<uint32_t>& chart_of_point) {
  std::vector<dvec3>& points = cut.flat.points;
  std::vector<std::vector<uint32_t>> ring(points.size());
  for (const Triangle& t : cut.flat.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      ring[t[k]].push_back(t[(k + 1) % 3]);
      ring[t[k]].push_back(t[(k + 2) % 3]);
    }
  }
  std::vector<dvec3> best = points;
  std::vector<uint32_t> fewest(cut.chart_count, none);
  for (int round = 0; round < 80; ++round) {
    std::vector<uint32_t> moving, turned(cut.chart_count, 0);
    for (const Triangle& t : cut.flat.triangles) {
      const dvec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
      if ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y) > 1e-9) continue;
      ++turned[chart_of_point[t[0]]];
      moving.insert(moving.end(), t.begin(), t.end());
      if (round % 3 == 2) {
        for (uint32_t v : t) moving.insert(moving.end(), ring[v].begin(), ring[v].end());
      }
    }
    for (size_t v = 0; v < points.size(); ++v) {
      const uint32_t c = chart_of_point[v];
      if (turned[c] < fewest[c]) best[v] = points[v];
    }
    for (uint32_t c = 0; c < cut.chart_count; ++c) fewest[c] = std::min(fewest[c], turned[c]);
    if (moving.empty()) break;
    std::sort(moving.begin(), moving.end());
    moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
    for (uint32_t v : moving) {
      dvec3 mean(0);
      for (uint32_t w : ring[v]) mean += points[w] / double(ring[v].size());
      points[v] = mix(points[v], mean, 0.7);
    }
  }
  points = best;
}

// Shelf packing with the largest scale that fits the unit square.
void pack(ChartMesh& cut, const std::vector<uint32_t>& chart_of_point, uint32_t chart_count) {
  std::vector<dvec2> low(chart_count, dvec2(1e300)), high(chart_count, dvec2(-1e300));
  for (size_t v = 0; v < cut.flat.points.size(); ++v) {
    low[chart_of_point[v]] = min(low[chart_of_point[v]], dvec2(cut.flat.points[v]));
    high[chart_of_point[v]] = max(high[chart_of_point[v]], dvec2(cut.flat.points[v]));
  }
  std::vector<uint32_t> order(chart_count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return high[a].y - low[a].y > high[b].y - low[b].y; });
  const double gap = 1.0 / 256;
  std::vector<dvec2> origin(chart_count);
  const auto fits = [&](double scale) {
    dvec2 cursor(gap);
    double shelf = 0;
    for (uint32_t c : order) {
      const dvec2 size = scale * (high[c] - low[c]);
      if (cursor.x + size.x + gap > 1) {
        cursor = {gap, cursor.y + shelf + gap};
        shelf = 0;
      }
      if (cursor.x + size.x + gap > 1 || cursor.y + size.y + gap > 1) return false;
      origin[c] = cursor;
      cursor.x += size.x + gap;
      shelf = std::max(shelf, size.y);
    }
    return true;
  };
  double inside = 0, outside = 1e3;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (fits(middle) ? inside : outside) = middle;
  }
  fits(inside);
  for (size_t v = 0; v < cut.flat.points.size(); ++v) {
    const uint32_t c = chart_of_point[v];
    const dvec2 p = origin[c] + inside * (dvec2(cut.flat.points[v]) - low[c]);
    cut.flat.points[v] = {p.x, p.y, 0};
  }
}

}  // namespace

ChartMesh make_charts(const Design& design, const TriangleMesh& mesh) {
  const std::vector<uint32_t> twin = twins(mesh);
  std::vector<uint32_t> label = label_triangles(design, mesh, twin);
  uint32_t chart_count = 0;
  const std::vector<uint32_t> chart = charts_of_labels(twin, label, chart_count);
  ChartMesh cut = cut_along_charts(mesh, twin, chart);
  cut.chart_count = chart_count;
  std::vector<uint32_t> chart_of_point(cut.flat.points.size());
  for (size_t t = 0; t < chart.size(); ++t) {
    for (uint32_t v : cut.flat.triangles[t]) chart_of_point[v] = chart[t];
  }
  // side view of each chart: its outward side faces the reader, the animal's up stays up as far as it can
  std::vector<uint32_t> label_of_chart(chart_count);
  for (size_t t = 0; t < chart.size(); ++t) label_of_chart[chart[t]] = label[t];
  for (size_t v = 0; v < cut.flat.points.size(); ++v) {
    const uint32_t own = label_of_chart[chart_of_point[v]];
    const dvec3 outward = design.groups[own / 2].axis * (own % 2 ? -1.0 : 1.0);
    const dvec3 right = normalize(cross(dvec3(0, 1, 0), outward)), up = cross(outward, right);
    const dvec3& p = mesh.points[cut.surface[v]];
    cut.flat.points[v] = {dot(p, right), dot(p, up), 0};
  }
  // the longest loop of a chart is its outline, the others are holes
  std::vector<std::vector<uint32_t>> loops = border_loops(cut, twin, chart);
  std::vector<uint32_t> outline(chart_count, none);
  for (uint32_t i = 0; i < loops.size(); ++i) {
    uint32_t& known = outline[chart_of_point[loops[i][0]]];
    const double area = std::abs(signed_area(loops[i], cut.flat.points));
    if (known == none || area > std::abs(signed_area(loops[known], cut.flat.points))) known = i;
  }
  std::vector<bool> fixed(cut.flat.points.size(), false);
  std::vector<std::vector<uint32_t>> holes;
  for (uint32_t i = 0; i < loops.size(); ++i) {
    if (outline[chart_of_point[loops[i][0]]] != i) {
      holes.push_back(loops[i]);
    } else {
      for (uint32_t v : loops[i]) fixed[v] = true;
    }
  }
  embed(mesh, cut, holes, fixed);
  unfold(cut, chart_of_point);
  pack(cut, chart_of_point, chart_count);
  return cut;
}

}  // namespace samples
