// Reads the names of joints. Words that most names have are dropped; the other words give the class, part and side.
#include "skeleton/names.h"

#include <algorithm>
#include <cstring>

#include "skeleton/body.h"
#include "skeleton/words.h"

namespace hf_inner::skeleton {
namespace {

struct Text {
  const char* data = nullptr;
  std::size_t size = 0;
  bool is(const char* word) const noexcept { return std::strlen(word) == size && std::memcmp(word, data, size) == 0; }
  bool begins(const char* word) const noexcept {
    const std::size_t length = std::strlen(word);
    return length <= size && std::memcmp(word, data, length) == 0;
  }
  bool ends(const char* word) const noexcept {
    const std::size_t length = std::strlen(word);
    return length <= size && std::memcmp(word, data + size - length, length) == 0;
  }
  Text part(std::size_t first, std::size_t count) const noexcept { return {data + first, count}; }
};

template <std::size_t n>
bool is_one_of(Text text, const char* const (&list)[n]) noexcept {
  return std::any_of(std::begin(list), std::end(list), [&](const char* word) { return text.is(word); });
}

// The word of the table that a text is, or its plural, or else the longest that it begins or ends with.
const Word* find_word(Text text) noexcept {
  const Text single = text.size > 3 && text.data[text.size - 1] == 's' ? text.part(0, text.size - 1) : text;
  for (const Text t : {text, single}) {
    for (const Word& word : words) {
      if (t.is(word.text)) return &word;
    }
  }
  if (text.size < 5 || is_one_of(text, not_words)) return nullptr;
  const Word* best = nullptr;
  for (const Word& word : words) {
    if (word.whole || !(text.begins(word.text) || text.ends(word.text))) continue;
    if (!best || std::strlen(word.text) > std::strlen(best->text)) best = &word;
  }
  return best;
}

// 1 left, -1 right, 0 none. rest: the text without the side, where it is written together with a word: larm, leftarm,
// arml.
int side_of(Text text, Text& rest) noexcept {
  rest = {};
  if (is_one_of(text, left_words)) return 1;
  if (is_one_of(text, right_words)) return -1;
  rest = text;
  if (text.is("rear")) return 0;
  if (find_word(text) && !text.begins("left") && !text.begins("right")) return 0;
  for (const auto& [word, sign] :
       {std::pair{"left", 1}, std::pair{"right", -1}, std::pair{"l", 1}, std::pair{"r", -1}}) {
    const std::size_t length = std::strlen(word);
    if (text.size < length + 3) continue;
    const Text behind = text.part(length, text.size - length), before = text.part(0, text.size - length);
    if (text.begins(word) && find_word(behind) && (length > 1 || behind.is(find_word(behind)->text)))
      return rest = behind, sign;
    if (text.ends(word) && find_word(before) && (length > 1 || before.is(find_word(before)->text)))
      return rest = before, sign;
  }
  return 0;
}

std::uint64_t hash_of(Text text, std::uint64_t hash = 1469598103934665603u) noexcept {  // FNV-1a
  for (std::size_t i = 0; i < text.size; ++i) hash = (hash ^ static_cast<unsigned char>(text.data[i])) * 1099511628211u;
  return hash;
}

// The words of all names, in small letters.
class Tokens {
 public:
  explicit Tokens(const Body& body) : letters_(&body.memory), tokens_(&body.memory), starts_(&body.memory) {
    const bool numbered = all_numbered(body);
    letters_.reserve(length_of(body));
    for (Index j = 0; j < body.count; ++j) {
      starts_.push_back(tokens_.size());
      if (body.kept[at(j)]) add(name_of(body, j), numbered);
    }
    starts_.push_back(tokens_.size());
  }
  Span<const Text> of(Index joint) const {
    return {tokens_.data() + starts_[at(joint)], starts_[at(joint) + 1] - starts_[at(joint)]};
  }

 private:
  static constexpr std::size_t most_letters = 256;  // of one name
  static Text name_of(const Body& body, Index joint) {
    const char* name = body.input.names ? body.input.names[at(joint)] : nullptr;
    if (!name) return {};
    std::size_t size = 0;
    while (size < most_letters && name[size]) ++size;
    return {name, size};
  }
  static std::size_t length_of(const Body& body) {
    std::size_t sum = 0;
    for (Index j = 0; j < body.count; ++j) sum += name_of(body, j).size;
    return sum;
  }
  static bool digit(char c) { return c >= '0' && c <= '9'; }
  static bool upper(char c) { return c >= 'A' && c <= 'Z'; }
  static bool letter(char c) { return upper(c) || (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

  // Without the number that an exporter put behind every name: Arm_L_012.
  static Text unnumbered(Text name) {
    std::size_t end = name.size;
    while (end > 0 && digit(name.data[end - 1])) --end;
    return end > 1 && end < name.size && name.data[end - 1] == '_' ? name.part(0, end - 1) : name;
  }
  static bool all_numbered(const Body& body) {
    std::size_t all = 0, numbered = 0;
    Vector<std::uint64_t> plain(&body.memory);
    for (Index j = 0; j < body.count; ++j) {
      const Text name = name_of(body, j);
      if (!body.kept[at(j)] || name.size == 0) continue;
      ++all;
      numbered += unnumbered(name).size < name.size;
      plain.push_back(hash_of(unnumbered(name)));
    }
    std::sort(plain.begin(), plain.end());
    return static_cast<double>(numbered) > common_word * static_cast<double>(all) &&
           std::adjacent_find(plain.begin(), plain.end()) == plain.end();
  }
  // A word ends at a character that is no letter, before a capital, and between letters and digits; FBXASC046 stands
  // for a character.
  void add(Text name, bool numbered) {
    if (numbered) name = unnumbered(name);
    for (std::size_t i = 0; i < name.size;) {
      if (i + 9 <= name.size && name.part(i, 6).is("FBXASC")) {
        i += 9;
        continue;
      }
      const bool number = digit(name.data[i]);
      if (!number && !letter(name.data[i])) {
        ++i;
        continue;
      }
      const std::size_t begin = letters_.size(), first = i;
      do letters_.push_back(upper(name.data[i]) ? static_cast<char>(name.data[i] - 'A' + 'a') : name.data[i]);
      while (++i < name.size && (number ? digit(name.data[i]) : letter(name.data[i])) && !starts_word(name, first, i) &&
             !(i + 9 <= name.size && name.part(i, 6).is("FBXASC")));
      tokens_.push_back({letters_.data() + begin, letters_.size() - begin});
    }
  }
  // A capital after a small letter, or the last of several before a small one: IKPole.
  static bool starts_word(Text name, std::size_t first, std::size_t i) {
    if (!upper(name.data[i])) return false;
    const bool small_next = i + 1 < name.size && letter(name.data[i + 1]) && !upper(name.data[i + 1]);
    return !upper(name.data[i - 1]) || (small_next && i > first);
  }

  Vector<char> letters_;  // reserved: the tokens point into it
  Vector<Text> tokens_;
  Vector<std::size_t> starts_;
};

// Words that most names have.
Vector<std::uint64_t> common_words(const Body& body, const Tokens& tokens) {
  Vector<std::uint64_t> all(&body.memory), common(&body.memory);
  std::size_t names = 0;
  for (Index j = 0; j < body.count; ++j) {
    const std::size_t first = all.size();
    for (const Text& t : tokens.of(j)) all.push_back(hash_of(t));
    const auto own = all.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(own, all.end());
    all.erase(std::unique(own, all.end()), all.end());
    names += body.kept[at(j)];
  }
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end] == all[i]) ++end;
    if (names > 4 && static_cast<double>(end - i) > common_word * static_cast<double>(names)) common.push_back(all[i]);
    i = end;
  }
  return common;
}

void add_part(JointName& name, Part part) noexcept {
  name.collar |= part == Part::collar;
  name.hand |= part == Part::hand;
  name.foot |= part == Part::foot;
  name.toe |= part == Part::toe;
  name.lower |= part == Part::lower;
  name.hip |= part == Part::hip;
}

// The class of a name whose words are of several.
NameClass choose_class(const bool (&has)[class_count], const JointName& name, bool sure_digit,
                       bool only_collar) noexcept {
  const auto any = [&](NameClass c) { return has[static_cast<std::size_t>(c)]; };
  NameClass found = NameClass::none;
  for (std::size_t c = 1; c < class_count && found == NameClass::none; ++c) {
    const bool bare_digit =
        c == static_cast<std::size_t>(NameClass::digit) && !sure_digit && !any(NameClass::arm) && name.side == 0;
    if (has[c] && !bare_digit) found = static_cast<NameClass>(c);
  }
  if (found == NameClass::digit && any(NameClass::leg)) found = NameClass::leg;            // a toe of the thumb's name
  if (found == NameClass::arm && only_collar && name.side == 0) found = NameClass::trunk;  // "shoulders"
  if (found == NameClass::trunk && name.side != 0 && name.hip) found = NameClass::leg;
  return found;
}

JointName read_name(Span<const Text> tokens, const Vector<std::uint64_t>& common) {
  JointName name;
  bool has[class_count] = {}, sure_digit = false, only_collar = true;
  std::uint64_t key = 1469598103934665603u;
  for (const Text& token : tokens) {
    if (std::binary_search(common.begin(), common.end(), hash_of(token))) continue;
    Text rest;
    const int side = side_of(token, rest);
    if (side != 0) name.side = static_cast<std::int8_t>(side);
    if (rest.size > 0) key = hash_of({" ", 1}, hash_of(rest, key));
    if (rest.begins("front") || rest.is("fore")) name.along = 1;
    if (rest.begins("back") || rest.begins("hind") || rest.begins("rear")) name.along = -1;
    if (rest.begins("lower")) name.lower = true;
    if (rest.begins("twist") || rest.ends("twist")) name.twist = true;
    const Word* word = rest.size > 0 ? find_word(rest) : nullptr;
    if (!word) continue;
    has[static_cast<std::size_t>(word->named)] = true;
    add_part(name, word->part);
    only_collar &= word->part == Part::collar;
    sure_digit |= word->named == NameClass::digit && !word->whole;
  }
  name.named = choose_class(has, name, sure_digit, only_collar);
  name.key = key;
  return name;
}

NameClass class_of(Role role) noexcept {
  switch (role) {
    case Role::spine:
      return NameClass::trunk;
    case Role::neck:
      return NameClass::neck;
    case Role::head:
      return NameClass::head;
    case Role::jaw:
      return NameClass::jaw;
    case Role::shoulder:
    case Role::arm:
    case Role::hand:
      return NameClass::arm;
    case Role::finger:
      return NameClass::digit;
    case Role::leg:
    case Role::foot:
    case Role::toe:
      return NameClass::leg;
    case Role::tail:
      return NameClass::tail;
    case Role::wing:
      return NameClass::wing;
    case Role::ear:
      return NameClass::ear;
    case Role::eye:
      return NameClass::eye;
    case Role::antenna:
      return NameClass::antenna;
    case Role::fin:
      return NameClass::fin;
    case Role::other:
      return NameClass::loose;
  }
  return NameClass::none;
}

void name_declared(Body& body) {
  std::uint32_t declared = 0;
  for (std::size_t j = 0; body.input.roles && j < at(body.count); ++j) {
    if (body.input.roles[j] < 0) continue;
    const Role role = static_cast<Role>(body.input.roles[j]);
    JointName& name = body.names[j];
    name.named = class_of(role);
    if (body.input.sides)
      name.side = static_cast<std::int8_t>(body.input.sides[j] == 1 ? 1 : body.input.sides[j] == 2 ? -1 : 0);
    name.collar = role == Role::shoulder;
    name.hand = role == Role::hand;
    name.foot = role == Role::foot;
    name.toe = role == Role::toe;
    name.lower = false;
    ++declared;
  }
  if (declared > 0) body.say("%u joints have declared roles.", declared);
}

}  // namespace

void read_names(Body& body) {
  body.names.assign(at(body.count), JointName{});
  const Tokens tokens(body);
  const Vector<std::uint64_t> common = common_words(body, tokens);
  for (Index j = 0; j < body.count; ++j) body.names[at(j)] = read_name(tokens.of(j), common);
  name_declared(body);
  std::size_t kept = 0, classed = 0;
  for (std::size_t j = 0; j < at(body.count); ++j) {
    kept += body.kept[j];
    classed += body.kept[j] && body.names[j].named != NameClass::none;
  }
  body.named = 10 * classed > kept;
  if (!body.named) {
    for (JointName& name : body.names) name.named = NameClass::none;
    body.say("The names of the joints say nothing.");
  } else {
    body.say("%zu of %zu names say what their joint is.", classed, kept);
  }
}

}  // namespace hf_inner::skeleton
