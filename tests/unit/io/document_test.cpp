#include "undine/io/case/document.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

Document document(std::string_view source) { return Document::parse(source, "folder/case.toml"); }

/// The message that the action ends with.
std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << "no \"" << word << "\" in: " << text;
}

constexpr const char* example = R"(title = "Dam break"
[fluid]
spacing = "5 mm"
density = 1000
size = ["1 m", 0.5]
velocity = ["2 * y", 0, "U"]
steps = 1e3
viscous = true
kernel = "wendland_c2"
file = "data/points.csv"
cells = [3, 4]
forces = ["gravity", "drag"]
[[gauge]]
at = 1
[[gauge]]
at = "2 cm"
)";

// Criterion: the values that the file states, in SI units.
TEST(Document, ReadsEveryKindOfValue) {
  const auto file = document(example);
  const auto root = file.root();
  EXPECT_EQ(root.text("title"), "Dam break");
  const auto fluid = root.table("fluid");
  EXPECT_EQ(fluid.positive("spacing", unit::length), 0.005);
  EXPECT_EQ(fluid.quantity("density", unit::density), 1000);
  EXPECT_EQ(fluid.quantities("size", unit::length, 2), (std::vector<double>{1, 0.5}));
  const auto velocity = fluid.expressions("velocity", 3, {{"U", 7.0}});
  EXPECT_EQ(velocity[0](0, 3, 0, 0), 6);
  EXPECT_EQ(velocity[1](0, 3, 0, 0), 0);
  EXPECT_EQ(velocity[2](0, 3, 0, 0), 7);
  EXPECT_EQ(fluid.integer("steps"), 1000);
  EXPECT_TRUE(fluid.flag("viscous"));
  EXPECT_EQ(fluid.choice("kernel", {"cubic_spline", "wendland_c2"}), "wendland_c2");
  EXPECT_EQ(fluid.path("file"), std::filesystem::path("folder/data/points.csv"));
  EXPECT_EQ(fluid.integers("cells", 2), (std::vector<std::int64_t>{3, 4}));
  EXPECT_EQ(fluid.choices("forces", {"drag", "gravity"}), (std::vector<std::string>{"gravity", "drag"}));
  const auto gauges = root.tables("gauge");
  ASSERT_EQ(gauges.size(), 2u);
  EXPECT_EQ(gauges[0].quantity("at", unit::length), 1);
  EXPECT_EQ(gauges[1].quantity("at", unit::length), 0.02);
  EXPECT_EQ(gauges[1].name(), "gauge[1]");
  EXPECT_EQ(fluid.where("spacing").text(), "folder/case.toml:3:11");
  EXPECT_EQ(fluid.where().text(), "folder/case.toml:2:1");
  EXPECT_NO_THROW(file.finish());
}

// Criterion: fallbacks as given, tables that the file lacks included, and all of it listed in order.
TEST(Document, TakesAndListsFallbacks) {
  const auto file = document("[a]\nx = \"2 mm\"");
  const auto a = file.root().table("a");
  EXPECT_EQ(a.quantity("x", unit::length), 0.002);
  EXPECT_EQ(a.quantity("y", unit::time, 3), 3);
  EXPECT_EQ(a.expression("f", 2.5)(1, 1, 1, 1), 2.5);
  EXPECT_EQ(a.quantities("v", unit::velocity, 2, {1, 2}), (std::vector<double>{1, 2}));
  const auto b = file.root().table("b").table("c");
  EXPECT_FALSE(b.exists());
  EXPECT_EQ(b.choice("k", {"p", "q"}, "q"), "q");
  EXPECT_EQ(b.integer("n", 4), 4);
  EXPECT_EQ(b.integer("n", 4), 4);
  EXPECT_FALSE(b.flag("on", false));
  EXPECT_TRUE(file.root().tables("none").empty());
  std::string all;
  for (const auto& [key, value] : file.resolved()) all += key + "=" + value + ";";
  EXPECT_EQ(all, "a.x=0.002 m;a.y=3 s;a.f=2.5;a.v=[1, 2] m/s;b.c.k=q;b.c.n=4;b.c.on=false;");
  EXPECT_NO_THROW(file.finish());
}

// Criterion: place, culprit and remedy are in the message.
TEST(Document, RefusesWrongValues) {
  const auto file = document(R"([a]
s = "0.5 s"
t = "abc"
n = nan
i = 1.5
bare = "0.5"
list = [1, "2 s"]
w = "wendlnd"
f = "sin(x"
g = "1 / 0"
neg = -1
empty = ""
many = ["p", "p"]
[[m]]
x = inf
)");
  const auto a = file.root().table("a");
  const auto said = [&](auto read) { return message([&] { read(a); }); };
  using T = const Table&;
  expect_words(said([](T t) { t.quantity("s", unit::length); }),
               {"folder/case.toml:2:5", "'s' is a length (m), but '0.5 s' is a time (s)", "in [a]"});
  expect_words(said([](T t) { t.quantity("t", unit::length); }),
               {":3:5", "'t' is a length (m)", "'abc' is not a quantity"});
  expect_words(said([](T t) { t.quantity("n", unit::length); }), {":4:5", "not a finite number"});
  expect_words(said([](T t) { t.integer("i"); }), {":5:5", "a whole number", "the number 1.5"});
  expect_words(said([](T t) { t.quantity("bare", unit::length); }), {":6:8", "'0.5' has no unit"});
  expect_words(said([](T t) { t.quantities("list", unit::length, 2); }), {":7:12", "'list[1]' is a length"});
  expect_words(said([](T t) { t.quantities("list", unit::length, 3); }), {":7:8", "needs 3 values, but has 2"});
  expect_words(said([](T t) {
                 t.choice("w", {"cubic", "wendland"});
               }),
               {":8:5", "unknown w 'wendlnd'", "did you mean 'wendland'?", "valid: cubic, wendland"});
  expect_words(said([](T t) { t.expression("f"); }), {":9:5", "column 4"});
  expect_words(said([](T t) { t.expression("g"); }), {":10:5", "not a finite number"});
  expect_words(said([](T t) { t.positive("neg", unit::length); }), {":11:7", "must be greater than 0, but is -1 m"});
  expect_words(said([](T t) { t.non_negative("neg", unit::length); }), {"must be 0 or more"});
  expect_words(said([](T t) { t.in_range("neg", unit::length, {0, 2}); }), {"must be from 0 to 2 m, but is -1 m"});
  expect_words(said([](T t) { t.path("empty"); }), {":12:9", "not a file name"});
  expect_words(said([](T t) { t.choices("many", {"p"}); }), {":13:14", "twice"});
  expect_words(said([](T t) { t.number("s"); }), {"must be a plain number, but is the string '0.5 s'"});
  expect_words(said([](T t) { t.flag("s"); }), {"must be true or false"});
  expect_words(said([](T t) { t.table("s"); }), {"must be a table"});
  expect_words(said([](T t) { t.tables("list"); }), {"'list[0]' must be a table"});
  expect_words(said([](T t) { t.fail("s", "too big", "the rule", "less"); }), {":2:5", "too big", "the rule", "less"});
  expect_words(message([&] { file.root().tables("m")[0].number("x"); }), {":15:5", "not a finite number", "in [m[0]]"});
}

// Criterion: the table's place, an example of the value, and the misspelt key or table if there is one.
TEST(Document, SaysWhatIsMissing) {
  const auto file = document("title = 1\n[flud]\nx = 1\n[body]\nspacng = 1");
  expect_words(
      message([&] { file.root().table("body").quantity("spacing", unit::length); }),
      {"folder/case.toml:4:1", "'spacing' is missing in [body]", "add spacing = 0.5 or \"0.5 m\"", "'spacng'"});
  expect_words(
      message([&] { file.root().table("fluid").quantity("spacing", unit::length); }),
      {"folder/case.toml: ", "'spacing' is missing in [fluid]", "no [fluid]", "was 'flud' meant to be 'fluid'"});
  expect_words(message([&] { file.root().text("name"); }), {"'name' is missing at the top of the file"});
}

// Criterion: every key that nobody read, at the key's place, in file order, with the nearest known key.
TEST(Document, FinishReportsUnreadKeys) {
  const auto file =
      document("zeta = 1\n[fluid]\nspacng = 1\nspacing = 2\ndepth = 3\n[[g]]\nx = 1\n  y = 2\n[none]\na = 1\n");
  const auto root = file.root();
  const auto fluid = root.table("fluid");
  fluid.number("spacing");
  EXPECT_TRUE(fluid.has("depth"));
  root.tables("g")[0].number("x");
  const auto text = message([&] { file.finish(); });
  expect_words(text, {"folder/case.toml:1:1: unknown key 'zeta' at the top of the file", "known keys here: fluid, g",
                      "also folder/case.toml:3:1: unknown key 'spacng' in [fluid] (did you mean 'spacing'?",
                      "folder/case.toml:5:1: key 'depth' in [fluid] is not used with these choices",
                      "folder/case.toml:8:3: unknown key 'y' in [g[0]]", "unknown key 'none'"});
}

// Criterion: values replaced, added and typed as TOML or text; problems are located at the override.
TEST(Document, AppliesOverrides) {
  auto file = document("[a]\nx = 1\nlist = [1, 2]\n[[b]]\ny = 1\n[[b]]\ny = 2\n");
  for (const auto* assignment : {"a.x=5 mm", "a.list[1]=7", "b[1].y=9", "new.table.z=[1, 2]", " a.name = two words ",
                                 "a.quoted='3'", "a.sub={k = 1}", "a[0].w=1"})
    file.set(assignment);
  const auto root = file.root();
  const auto a = root.table("a");
  EXPECT_EQ(a.quantity("x", unit::length), 0.005);
  EXPECT_EQ(a.quantities("list", unit::one, 2), (std::vector<double>{1, 7}));
  EXPECT_EQ(root.tables("b")[0].number("y"), 1);
  EXPECT_EQ(root.tables("b")[1].number("y"), 9);
  EXPECT_EQ(root.table("new").table("table").integers("z", -1).size(), 2u);
  EXPECT_EQ(a.text("name"), "two words");
  EXPECT_EQ(a.text("quoted"), "3");
  EXPECT_EQ(a.table("sub").number("k"), 1);
  EXPECT_EQ(a.number("w"), 1);
  EXPECT_EQ(a.where("x").text(), "--set a.x");
  EXPECT_NO_THROW(file.finish());
  EXPECT_THROW(file.set("a.x=1"), std::logic_error);
}

// Criterion: each message is located at "--set KEY" and names the trouble.
TEST(Document, RefusesWrongOverrides) {
  const auto said = [](const char* assignment) {
    return message([&] {
      auto file = document("a = 1\nlist = [1, 2]\n[fluid]\nspacing = 1\n");
      file.set(assignment);
      const auto root = file.root();
      root.number("a");
      root.quantities("list", unit::one, 2);
      root.table("fluid").quantity("spacing", unit::length);
      file.finish();
    });
  };
  expect_words(said("a"), {"--set a: ", "key=value"});
  expect_words(said("=1"), {"is not a key"});
  expect_words(said("a..b=1"), {"is not a key"});
  expect_words(said("a[=1"), {"is not a key"});
  expect_words(said("a[99999999999999999999]=1"), {"is not a key"});
  expect_words(said("a.b=1"), {"--set a.b: ", "inside the whole number 1"});
  expect_words(said("list[2]=1"), {"--set list[2]: ", "has 2 elements"});
  expect_words(said("list.x=1"), {"say which element"});
  expect_words(said("fluid[0]=1"), {"cannot be replaced"});
  expect_words(said("fluid.spacng=1"),
               {"--set fluid.spacng: unknown key 'spacng' in [fluid]", "did you mean 'spacing'?"});
  expect_words(said("flud.spacing=1"), {"--set flud.spacing: unknown key 'flud'", "did you mean 'fluid'?"});
  expect_words(said("fluid.spacing=3 s"), {"--set fluid.spacing: ", "is a time (s)"});
  expect_words(said("list[0]=x"), {"--set list[0]: ", "'list[0]' is a plain number"});
}

// Criterion: file, line and column of what TOML does not allow; a file that cannot be read is named.
TEST(Document, SaysWhyAFileCannotBeRead) {
  expect_words(message([] { document("a = 1\nb = = 2"); }), {"folder/case.toml:2:5", "not valid TOML", "why: "});
  expect_words(message([] { document("a = 1\na = 2"); }), {"folder/case.toml:2", "redefine"});
  expect_words(message([] { Document::load("/nowhere/case.toml"); }), {"/nowhere/case.toml: ", "no such file"});
  expect_words(message([] { Document::load("/"); }), {"it is a folder"});
  std::string deep = "a";
  for (int k = 0; k < 100000; ++k) deep += ".a";
  expect_words(message([&] { document(deep + " = 1"); }), {"dots"});
  expect_words(message([&] { document("a = " + std::string(100000, '[')); }), {"not valid TOML"});
}

// Criterion: what was written is read; paths begin at the file's folder.
TEST(Document, LoadsAFile) {
  const auto folder = std::filesystem::temp_directory_path() / "undine_document_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "case.toml") << "a = 1\nfile = \"b.csv\"\n";
  const auto file = Document::load(folder / "case.toml");
  EXPECT_EQ(file.root().number("a"), 1);
  EXPECT_EQ(file.root().path("file"), folder / "b.csv");
  std::filesystem::remove_all(folder);
}

// Criterion: any text gives a document or an InputError, nothing else; the same for any override.
RC_GTEST_PROP(Document, GarbageOnlyThrowsInputError, ()) {
  const auto words = rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
      "a", "b", "fluid", "=", " = ", "\n", "[", "]", "[[", "]]", "{", "}", ",", ".", "1", "1.5", "nan", "\"", "\"\"\"",
      "'", "#", "true", "2020-01-01", "\\u0000", "\xff", "0x", "[0]"));
  std::string source;
  for (const auto& word : *words) source += word;
  const auto overrides = *words;
  std::string assignment = "a";
  for (const auto& word : overrides) assignment += word;
  for (const auto& text : {source, std::string("a = 1\n")}) {
    try {
      auto file = document(text);
      file.set(assignment);
      const auto root = file.root();
      root.table("fluid").quantity("a", unit::length, 1);
      root.expression("b", 0.0);
      root.tables("a");
      file.finish();
    } catch (const InputError&) {
    }
  }
}

// Criterion: a finite value is read back bit for bit, bare and with a unit.
RC_GTEST_PROP(Document, ReadsNumbersExactly, (double value)) {
  RC_PRE(std::isfinite(value));
  const auto file = document("a = \"" + text(Quantity{value, unit::density}) + "\"");
  RC_ASSERT(file.root().quantity("a", unit::density) == value);
}

}  // namespace
}  // namespace undine
