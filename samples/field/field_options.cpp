#include "field/field_options.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/limits.h"
#include "gltf/file_bytes.h"
#include "gltf/file_name.h"
#include "hf/hf.h"

namespace samples {

using namespace hf_gltf;

const char* const field_usage =
    "usage: hf_field MESH --site PLACE=VALUE[@STIFFNESS] ... [options]\n"
    "       hf_field --sheet MESH ... --png START\n"
    "  Solves a field on a .obj, .off, .ply, .stl or glTF surface, edits it, and prints the time of every edit.\n"
    "  PLACE is a vertex number (from 0, as in the file), or TRIANGLE:B0,B1,B2 for a point inside a triangle.\n"
    "  VALUE is a number, with --kind vector and direction three with commas.\n"
    "  STIFFNESS makes a soft site (relative to the mean diagonal); without it the site is exact.\n"
    "  --kind NAME        harmonic (default), biharmonic, vector (tangent vectors by components), direction (by "
    "parallel\n"
    "                     transport; sites at vertices; singularities are listed)\n"
    "  --script FILE      edits, one a line: add PLACE=VALUE ..., remove PLACE ..., move PLACE PLACE ..., set "
    "PLACE=VALUE ..., undo, redo\n"
    "  --extremities [poisson|geodesic]   lists the tips of the surface; without other sites they become the sites\n"
    "  --isolines N       N iso-lines as lines, in the picture and in the glb\n"
    "  --levels NAME      strips and lines of equal value (default), area, or length (mean width)\n"
    "  --critical-points  lists minima, maxima and saddles; in the picture blue, red and green dots\n"
    "  --out FILE         the field as text, one row a vertex in the file's own order, 17 digits\n"
    "  --glb FILE         the surface cut into colour strips, iso-lines or arrows as lines\n"
    "  --png FILE         a picture: strips from blue to yellow, sites red; vectors as arrows\n"
    "  --strips N         number of strips (24)\n"
    "  --direction X,Y,Z  from where the picture looks (0.8,0.35,1)\n"
    "  --sheet MESH ...   every kind of field on every mesh, one picture a kind: START_harmonic.png and so on\n"
    "  --engine NAME      green (default); updown, refactor: baselines, in builds with HF_WITH_PEERS\n"
    "  --operator NAME    delaunay (default), clamped, uniform, cotangent (the paper's)\n"
    "  --paper            the paper's own way: --engine updown --operator cotangent\n"
    "  --weld NAME        exact (default), none\n"
    "  --no-links         pieces of the surface stay apart; otherwise links join them (never with --paper)\n"
    "  --threads N        threads the library may use (1)\n"
    "  --work-limit N     refuse a factorisation of more than N * 10^9 operations (default: by the size)\n"
    "  --memory-limit N   refuse a surface that holds more than N MiB (default: by the size)\n";

namespace {

double read_number(const std::string& text, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw std::runtime_error(what + ": \"" + text + "\" is not a finite number");
  return value;
}

uint32_t read_index(const std::string& text, const std::string& what) {
  char* end = nullptr;
  const unsigned long long value = std::strtoull(text.c_str(), &end, 10);
  if (text.empty() || text[0] == '-' || *end != '\0' || value > 0xFFFFFFFEull)
    throw std::runtime_error(what + ": \"" + text + "\" is not a number of a vertex or triangle");
  return static_cast<uint32_t>(value);
}

std::array<double, 3> read_triple(const std::string& text, const std::string& what) {
  std::array<double, 3> triple{};
  std::istringstream stream(text);
  std::string part;
  for (double& value : triple) {
    if (!std::getline(stream, part, ','))
      throw std::runtime_error(what + ": \"" + text + "\" must be three numbers with commas");
    value = read_number(part, what);
  }
  if (std::getline(stream, part)) throw std::runtime_error(what + ": \"" + text + "\" has more than three numbers");
  return triple;
}

Place read_place(const std::string& text, const std::string& what) {
  Place place;
  const size_t colon = text.find(':');
  if (colon == std::string::npos) {
    place.vertex = read_index(text, what);
  } else {
    place.triangle = read_index(text.substr(0, colon), what);
    place.weights = read_triple(text.substr(colon + 1), what);
  }
  return place;
}

SiteArgument read_site(const std::string& text, const std::string& what) {
  const size_t equal = text.find('=');
  if (equal == std::string::npos) throw std::runtime_error(what + ": \"" + text + "\" has no value; write PLACE=VALUE");
  SiteArgument site;
  site.place = read_place(text.substr(0, equal), what);
  std::string value = text.substr(equal + 1);
  const size_t mark = value.find('@');
  if (mark != std::string::npos) {
    site.stiffness = read_number(value.substr(mark + 1), what + ": stiffness");
    if (!(site.stiffness > 0)) throw std::runtime_error(what + ": stiffness must be above 0");
    value.resize(mark);
  }
  if (value.find(',') == std::string::npos) {
    site.values = {read_number(value, what)};
  } else {
    const auto vector = read_triple(value, what);
    site.values.assign(vector.begin(), vector.end());
  }
  return site;
}

int read_choice(const std::string& text, std::initializer_list<const char*> names, const std::string& what) {
  int index = 0;
  std::string all;
  for (const char* name : names) {
    if (text == name) return index;
    all += (index++ ? ", " : "") + std::string(name);
  }
  throw std::runtime_error(what + ": \"" + text + "\" is none of " + all);
}

// Every site has as many values as the field has components.
void check_components(const std::vector<SiteArgument>& sites, size_t components, const std::string& what) {
  for (const SiteArgument& site : sites) {
    if (site.values.size() != components)
      throw std::runtime_error(what + ": a site has " + std::to_string(site.values.size()) +
                               " values; this kind of field " +
                               (components == 3 ? "takes vectors, X,Y,Z" : "takes one"));
  }
}

}  // namespace

FieldOptions read_field_options(int argc, char** argv) {
  FieldOptions options;
  bool sheet = false;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto next = [&]() -> std::string {
      if (i + 1 >= argc) throw std::runtime_error(name + " needs a value");
      return argv[++i];
    };
    if (name == "--help" || name == "-h")
      options.help = true;
    else if (name == "--site")
      options.sites.push_back(read_site(next(), name));
    else if (name == "--script")
      options.script = next();
    else if (name == "--out")
      options.out = next();
    else if (name == "--glb")
      options.glb = next();
    else if (name == "--png")
      options.png = next();
    else if (name == "--strips")
      options.strips = static_cast<int>(read_index(next(), name));
    else if (name == "--direction")
      options.direction = read_triple(next(), name);
    else if (name == "--kind")
      options.kind =
          static_cast<FieldType>(read_choice(next(), {"harmonic", "biharmonic", "vector", "direction"}, name));
    else if (name == "--extremities")
      options.extremities =
          i + 1 < argc && (std::string(argv[i + 1]) == "poisson" || std::string(argv[i + 1]) == "geodesic")
              ? read_choice(next(), {"poisson", "geodesic"}, name)
              : 0;
    else if (name == "--isolines")
      options.isolines = static_cast<int>(read_index(next(), name));
    else if (name == "--levels")
      options.levels = read_choice(next(), {"value", "area", "length"}, name);
    else if (name == "--critical-points")
      options.critical_points = true;
    else if (name == "--sheet")
      sheet = true;
    else if (name == "--no-links")
      options.links = false;
    else if (name == "--threads")
      options.threads = read_index(next(), name);
    else if (name == "--engine")
      options.engine = static_cast<Engine>(read_choice(next(), {"green", "updown", "refactor"}, name));
    else if (take_limit(name, next))
      continue;
    else if (name == "--operator")
      options.operator_kind = read_choice(next(), {"delaunay", "clamped", "uniform", "cotangent"}, name);
    else if (name == "--paper") {
      options.engine = Engine::updown;
      options.operator_kind = HF_OPERATOR_COTANGENT;
      options.links = false;
    } else if (name == "--weld")
      options.weld = read_choice(next(), {"exact", "none"}, name);
    else if (name.rfind("--", 0) == 0)
      throw std::runtime_error("unknown option " + name + "; see --help");
    else if (sheet)
      options.sheet.push_back(name);
    else if (options.mesh.empty())
      options.mesh = name;
    else
      throw std::runtime_error("more than one mesh: " + options.mesh + " and " + name);
  }
  if (options.help) return options;
  if (sheet) {
    if (options.sheet.empty() || options.png.empty())
      throw std::runtime_error("--sheet needs meshes behind it and --png START before");
    return options;
  }
  if (options.mesh.empty()) throw std::runtime_error("no mesh given; see --help");
  if (options.strips < 1 || options.strips > 1000) throw std::runtime_error("--strips must be 1 to 1000");
  if (options.isolines < 0 || options.isolines > 10000) throw std::runtime_error("--isolines must be 0 to 10000");
  const bool vectors = options.kind == FieldType::vector || options.kind == FieldType::direction;
  check_components(options.sites, vectors ? 3 : 1, "--site");
  if (vectors && (options.isolines || options.critical_points))
    throw std::runtime_error("--isolines and --critical-points need a scalar field: --kind harmonic or biharmonic");
  return options;
}

std::vector<Edit> read_edit_script(const std::string& file, size_t components) {
  std::ifstream stream(file_named(file));
  if (!stream) throw std::runtime_error(file + ": cannot be read");
  std::vector<Edit> edits;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1) line.erase(0, hf_gltf::text_begin(line, file));
    if (const size_t hash = line.find('#'); hash != std::string::npos) line.resize(hash);
    std::istringstream words(line);
    std::string word;
    if (!(words >> word)) continue;
    const std::string where = file + ":" + std::to_string(number);
    Edit edit;
    edit.kind = static_cast<Edit::Kind>(read_choice(word, {"add", "remove", "move", "set", "undo", "redo"}, where));
    edit.text = word;
    while (words >> word) {
      edit.text += " " + word;
      if (edit.kind == Edit::Kind::add || edit.kind == Edit::Kind::set) {
        edit.sites.push_back(read_site(word, where));
      } else if (edit.kind == Edit::Kind::remove || edit.kind == Edit::Kind::move) {
        edit.sites.push_back({read_place(word, where), {}, 0});
      } else {
        throw std::runtime_error(where + ": \"" + word + "\" after " + edit.text);
      }
    }
    if (edit.kind == Edit::Kind::add || edit.kind == Edit::Kind::set) check_components(edit.sites, components, where);
    const bool needs = edit.kind != Edit::Kind::undo && edit.kind != Edit::Kind::redo;
    if (needs && edit.sites.empty()) throw std::runtime_error(where + ": no place given");
    if (edit.kind == Edit::Kind::move && edit.sites.size() % 2)
      throw std::runtime_error(where + ": move takes pairs of places, from and to");
    edits.push_back(std::move(edit));
  }
  return edits;
}

}  // namespace samples
