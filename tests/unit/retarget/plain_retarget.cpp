#include "plain_retarget.h"

#include <cctype>

#include "poses.h"

namespace hf_test {

using hf_inner::Vec3;
using hf_inner::retarget::Turn;
using hf_inner::skeleton::CharacterInput;

std::string plain_part(const std::string& name) {
  std::string low, side;
  for (const char c : name.substr(name.find(':') + 1)) low += static_cast<char>(std::tolower(c));
  const auto has = [&](const std::string& word) { return low.find(word) != std::string::npos; };
  for (const char* other : {"twist", "ik", "pole", "end", "nub"})
    if (has(other)) return {};
  std::string apart = " " + low + " ";
  for (char& c : apart) c = std::isalpha(static_cast<unsigned char>(c)) ? c : ' ';
  for (const std::string word : {"left", "right"}) {
    // a letter alone: between signs, or a capital at the end
    const bool capital = name.size() > 1 && std::tolower(name.back()) == word[0] && std::isupper(name.back()) &&
                         std::islower(name[name.size() - 2]);
    if (has(word) || capital || apart.find({' ', word[0], ' '}) != std::string::npos) side = word + " ";
  }
  static const char* const words[][2] = {
      {"thumb", "thumb"},   {"index", "index"},   {"middle", "middle"},  {"ring", "ring"},       {"pinky", "little"},
      {"little", "little"}, {"finger", "finger"}, {"forearm", "fore"},   {"lowerarm", "fore"},   {"hand", "hand"},
      {"wrist", "hand"},    {"fist", "hand"},     {"arm", "arm"},        {"clavicle", "collar"}, {"shoulder", "collar"},
      {"thigh", "thigh"},   {"upleg", "thigh"},   {"upperleg", "thigh"}, {"calf", "shin"},       {"shin", "shin"},
      {"leg", "shin"},      {"foot", "foot"},     {"toe", "toe"},        {"ball", "toe"},        {"hips", "hips"},
      {"pelvis", "hips"},   {"spine", "spine"},   {"chest", "spine"},    {"torso", "spine"},     {"neck", "neck"},
      {"head", "head"}};
  for (const auto& [word, part] : words)
    if (has(word)) return side + part;
  return {};
}

PlainRetarget::Bone PlainRetarget::Rig::posed(const std::vector<Bone>& bones, std::size_t joint,
                                              const double* trs) const {
  const double* t = trs + 10 * joint;
  const Bone above = parents[joint] < 0 ? Bone{} : bones[static_cast<std::size_t>(parents[joint])];
  return {above.turn * Turn{t[3], t[4], t[5], t[6]}, above.place + above.turn * (above.scale * Vec3{t[0], t[1], t[2]}),
          above.scale * t[7]};
}

std::vector<PlainRetarget::Bone> PlainRetarget::Rig::pose(const double* trs) const {
  std::vector<Bone> bones(parents.size());
  for (const std::size_t j : order) bones[j] = posed(bones, j, trs);
  return bones;
}

PlainRetarget::Rig::Rig(const CharacterInput& in)
    : parents(in.parents, in.parents + in.joint_count), trs(rest_trs(in)) {
  std::vector<char> done(parents.size(), 0);
  while (order.size() < parents.size()) {
    for (std::size_t j = 0; j < parents.size(); ++j) {
      if (done[j] || (parents[j] >= 0 && !done[static_cast<std::size_t>(parents[j])])) continue;
      done[j] = 1;
      order.push_back(j);
    }
  }
  std::map<std::string, int> count;
  for (const std::size_t j : order) {
    std::string part = plain_part(in.names[j] ? in.names[j] : "");
    if (part.empty()) continue;
    if (const int k = count[part]++) part += std::to_string(k);  // pieces of a spine and of a finger
    parts[part] = static_cast<int>(j);
  }
  rest = pose(trs.data());
  const auto place = [&](const char* part) {
    const auto found = parts.find(part);
    return found == parts.end() ? Vec3{} : rest[static_cast<std::size_t>(found->second)].place;
  };
  const Vec3 left = unit_vector(place("left thigh") - place("right thigh"));
  const Vec3 spine = place("head") - place("hips");
  const Vec3 up = unit_vector(spine - dot(spine, left) * left);
  axes = hf_inner::retarget::turn_of_frame(left, up, cross(left, up));
  leg = norm(place("left shin") - place("left thigh")) + norm(place("left foot") - place("left shin"));
}

PlainRetarget::PlainRetarget(const CharacterInput& source, const CharacterInput& target)
    : source_(source), target_(target), partners_(target.joint_count, -1) {
  for (const auto& [part, joint] : target_.parts) {
    if (const auto found = source_.parts.find(part); found != source_.parts.end())
      partners_[static_cast<std::size_t>(joint)] = found->second;
  }
}

void PlainRetarget::frame(const double* source, double* target) const {
  const Turn across = target_.axes * inverse(source_.axes);
  const std::vector<Bone> now = source_.pose(source);
  std::vector<Bone> bones(target_.parents.size());
  std::copy(target_.trs.begin(), target_.trs.end(), target);
  for (const std::size_t j : target_.order) {
    bones[j] = target_.posed(bones, j, target);
    if (partners_[j] < 0) continue;
    const std::size_t s = static_cast<std::size_t>(partners_[j]);
    const Bone above = target_.parents[j] < 0 ? Bone{} : bones[static_cast<std::size_t>(target_.parents[j])];
    const Turn since = across * now[s].turn * inverse(source_.rest[s].turn) * inverse(across);
    const Turn own = inverse(above.turn) * since * target_.rest[j].turn;
    const double turn[] = {own.x, own.y, own.z, own.w};
    std::copy(turn, turn + 4, target + 10 * j + 3);
    if (const auto hips = target_.parts.find("hips");
        hips != target_.parts.end() && hips->second == static_cast<int>(j)) {
      const Vec3 travel = (target_.leg / source_.leg) * (across * (now[s].place - source_.rest[s].place));
      const Vec3 o = (1 / above.scale) * (inverse(above.turn) * (target_.rest[j].place + travel - above.place));
      const double place[] = {o.x, o.y, o.z};
      std::copy(place, place + 3, target + 10 * j);
    }
    bones[j] = target_.posed(bones, j, target);
  }
}

}  // namespace hf_test
