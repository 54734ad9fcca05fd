// Fingers find each other by name, else by their order across the palm from the thumb.
#include <algorithm>
#include <cstring>

#include "retarget/match.h"

namespace hf_inner::retarget {
namespace {

struct Finger {
  const skeleton::Chain* chain = nullptr;
  int named = -1;    // thumb 0 to little finger 4
  double place = 0;  // across the palm, the thumb's side first
};

// By hand: std::tolower depends on the locale of the host.
char small_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool has_word(const char* text, const char* word) {
  const std::size_t n = std::strlen(word);
  for (; *text; ++text) {
    std::size_t k = 0;
    while (k < n && small_letter(text[k]) == word[k]) ++k;
    if (k == n) return true;
  }
  return false;
}

int finger_named(const skeleton::CharacterInput& in, Index joint) {
  static constexpr const char* words[][3] = {{"thumb", "polegar", nullptr},
                                             {"index", nullptr, nullptr},
                                             {"mid", nullptr, nullptr},
                                             {"ring", nullptr, nullptr},
                                             {"pink", "little", nullptr}};
  const char* name = in.names && in.names[joint] ? in.names[joint] : "";
  for (int f = 0; f < 5; ++f) {
    for (const char* const* word = words[f]; *word; ++word) {
      if (has_word(name, *word)) return f;
    }
  }
  return -1;
}

Vector<Finger> fingers_of(const Rig& rig, const RetargetSide& side, const skeleton::Chain& hand, Memory& memory) {
  const skeleton::Character& c = side.character;
  const Index hand_chain = static_cast<Index>(&hand - c.chains.data());
  Vector<Finger> out(&memory);
  // An arm that hangs down is raised to the side first: then thumbs of all rests point forward.
  const Index wrist = static_cast<Index>(c.chain_joints[hand.first]);
  const Index arm = rig.carriers[at(wrist)];
  const Vec3 along = arm >= 0 ? rig.rest.place[at(wrist)] - rig.rest.place[at(arm)] : Vec3{};
  const Turn raise = shortest_turn(along, hand.side == skeleton::Side::right ? -1.0 * rig.left : rig.left);
  for (const skeleton::Chain& chain : c.chains) {
    if (chain.role != skeleton::Role::finger || chain.parent != hand_chain) continue;
    const Index first = static_cast<Index>(c.chain_joints[chain.first]);
    const Vec3 place = raise * (rig.rest.place[at(first)] - rig.rest.place[at(wrist)]);
    out.push_back({&chain, finger_named(side.input, first), -dot(place, rig.forward + rig.up)});
  }
  std::stable_sort(out.begin(), out.end(), [](const Finger& a, const Finger& b) { return a.place < b.place; });
  return out;
}

}  // namespace

void Matcher::add_fingers(const skeleton::Chain& a, const skeleton::Chain& b, Turn align) {
  const Vector<Finger> from = fingers_of(r.source, s, a, memory), to = fingers_of(r.target, t, b, memory);
  const auto named = [](const Vector<Finger>& list) {
    return std::all_of(list.begin(), list.end(), [](const Finger& f) { return f.named >= 0; });
  };
  if (from.empty() || to.empty()) return;
  const bool by_name = named(from) && named(to);
  for (std::size_t k = 0; k < to.size(); ++k) {
    const skeleton::Chain* partner = nullptr;
    for (const Finger& f : from) {
      if (by_name && f.named == to[k].named) partner = f.chain;
    }
    if (!by_name)
      partner =
          from[to.size() < 2 ? from.size() / 2 : (k * (from.size() - 1) + (to.size() - 1) / 2) / (to.size() - 1)].chain;
    if (!partner) continue;
    ChainPair pair(memory);
    pair.role = skeleton::Role::finger;
    pair.side = b.side;
    pair.source = cut_chain(r.source, s.character, *partner, memory);
    pair.target = cut_chain(r.target, t.character, *to[k].chain, memory);
    add_pair(std::move(pair), r.options.align_rests ? Aligning::segments : Aligning::none, align);
  }
}

}  // namespace hf_inner::retarget
