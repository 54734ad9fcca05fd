// Settings files: errors name file and key; text is bounded before it is parsed.
#include <gtest/gtest.h>

#include "gltf/json_file.h"
#include "gltf_support.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;

TEST(JsonFile, ErrorsNameTheFileAndTheKeyPath) {
  TemporaryFolder folder;
  const auto file = folder.path / "pairs.json";
  write_text(file, R"({"handles":[{"vertex":3},{"vertex":"nose"}],"radius":0.5,"on":true,"big":18446744073709551615})");
  const JsonFile json_file(file);
  const JsonReader root = json_file.root();
  EXPECT_EQ(root.at("handles").at(0).at("vertex").integer(0, 10), 3);
  EXPECT_EQ(root.number_or("radius", 1), 0.5);
  EXPECT_EQ(root.number_or("absent", 1), 1);
  EXPECT_TRUE(root.boolean_or("on", false));
  const std::string message = message_of([&] { root.at("handles").at(1).at("vertex").integer(0, 4399); });
  EXPECT_NE(message.find("pairs.json"), std::string::npos);
  EXPECT_NE(message.find("handles[1].vertex"), std::string::npos);
  EXPECT_NE(message.find("\"nose\""), std::string::npos);
  EXPECT_NE(message_of([&] { root.at("handles").at(2); }).find("no element 2"), std::string::npos);
  EXPECT_NE(message_of([&] { root.at("weights"); }).find("weights"), std::string::npos);
  EXPECT_NE(message_of([&] { root.at("handles").at(0).at("vertex").integer(0, 2); }).find("0 to 2"), std::string::npos);
  EXPECT_NE(message_of([&] { root.at("big").integer(0, 100); }), "");
  EXPECT_NE(message_of([&] { root.expect_only({"handles", "radius"}); }).find("\"big\""), std::string::npos);
  EXPECT_NE(message_of([&] { JsonFile(folder.path / "none.json"); }).find("none.json"), std::string::npos);
}

TEST(JsonFile, TextIsBoundedBeforeItIsParsed) {
  const auto scan = [](const std::string& text) { return scan_json(text.data(), text.size(), 4, 10); };
  EXPECT_EQ(scan("[[[[1]]]]"), "");
  EXPECT_NE(scan("[[[[[1]]]]]").find("deeper"), std::string::npos);
  EXPECT_EQ(scan(R"({"a":"[[[[[[[[\"[["})"), "");
  EXPECT_NE(scan("[1,2,3,4,5,6,7,8,9,10,11,12]").find("more than"), std::string::npos);
  EXPECT_NE(scan("[").find("open"), std::string::npos);
  EXPECT_NE(scan("]").find("not opened"), std::string::npos);
  EXPECT_NE(scan("\"abc").find("string"), std::string::npos);
  EXPECT_NE(message_of([] { parse_json("[1,]", 4, "x.json"); }).find("x.json"), std::string::npos);
}

TEST(JsonFile, AByteOrderMarkIsPassedOverAndUtf16IsSaid) {
  TemporaryFolder folder;
  write_text(folder.path / "marked.json", "\xef\xbb\xbf[1]");
  EXPECT_EQ(JsonFile(folder.path / "marked.json").root().value(), json::array({1}));
  const std::string little("\xff\xfe[\0001\0]\0", 8), plain("[\0001\0]\0", 6);
  for (const std::string& text : {little, plain}) {
    EXPECT_EQ(message_of([&] { parse_json(text.data(), text.size(), "x.json"); }),
              "x.json: the text is UTF-16; save it as UTF-8.");
  }
}

TEST(JsonFile, WhatIsWrittenReadsBack) {
  TemporaryFolder folder;
  const json value = {{"a", {1, 2.5, "x"}}, {"b", nullptr}};
  write_json(folder.path / "out.json", value);
  EXPECT_EQ(JsonFile(folder.path / "out.json").root().value(), value);
}

}  // namespace
