#include "halfspace/csg/script.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace halfspace::csg {
namespace {

/// The script's result with every bracket there could be. Nodes come after
/// their operands, so one pass will do, however deep they are.
std::string shown(const Script& script) {
  std::vector<std::string> texts;
  for (const Node& node : script.nodes) {
    const auto at = [&](std::int32_t id) {
      return texts[static_cast<std::size_t>(id)];
    };
    const auto item = static_cast<std::size_t>(node.item);
    switch (node.kind) {
      case NodeKind::kFile:
        texts.push_back(script.files[item].path);
        break;
      case NodeKind::kHalf:
        texts.push_back("half" + std::to_string(item));
        break;
      case NodeKind::kComplement:
        texts.push_back("~" + at(node.left));
        break;
      case NodeKind::kTransform:
        texts.push_back("moved" + std::to_string(item) + at(node.left));
        break;
      default:
        texts.push_back("(" + at(node.left) +
                        "|&-^"[static_cast<std::size_t>(node.kind) - 2] +
                        at(node.right) + ")");
    }
  }
  return texts[static_cast<std::size_t>(script.result)];
}

/// The operands a to d, bound to files of those names.
std::vector<Binding> letters(const std::string& names) {
  std::vector<Binding> bindings;
  for (const char name : names)
    bindings.push_back({std::string(1, name), std::string(1, name)});
  return bindings;
}

std::string parsed(const std::string& text, const std::string& names) {
  const auto bindings = letters(names);
  const Result<Script> script = parse_script(text, bindings);
  return script ? shown(*script) : script.error().message;
}

/// What is wrong with the text, in which a, b and c are operands.
Error trouble(const std::string& text) {
  const auto bindings = letters("abc");
  const Result<Script> script = parse_script("z = a|b|c\n" + text, bindings);
  EXPECT_FALSE(script) << text;
  return script ? Error{ErrorCode::kUnreadable, "", -2} : script.error();
}

TEST(CsgScript, AndBindsMoreStronglyThanTheOthers) {
  EXPECT_EQ(parsed("(a - b) | c & d", "abcd"), "((a-b)|(c&d))");
  EXPECT_EQ(parsed("a & b - c & d", "abcd"), "((a&b)-(c&d))");
  EXPECT_EQ(parsed("a & (b - c) & d", "abcd"), "((a&(b-c))&d)");
}

TEST(CsgScript, SumsAreDoneFromLeftToRight) {
  EXPECT_EQ(parsed("a - b - c", "abc"), "((a-b)-c)");
  EXPECT_EQ(parsed("a - b | c ^ d", "abcd"), "(((a-b)|c)^d)");
  EXPECT_EQ(parsed("a - (b | (c ^ d))", "abcd"), "(a-(b|(c^d)))");
}

TEST(CsgScript, ComplementsBindMostStrongly) {
  EXPECT_EQ(parsed("~a & b", "ab"), "(~a&b)");
  EXPECT_EQ(parsed("a - ~~b", "ab"), "(a-~~b)");
  EXPECT_EQ(parsed("~(a | b)", "ab"), "~(a|b)");
}

TEST(CsgScript, ANameStandsForWhatWasLastAboveIt) {
  EXPECT_EQ(parsed("x = a - b\nx = x | c\nx & a", "abc"), "(((a-b)|c)&a)");
  EXPECT_EQ(parsed("a = a | b; y = a ^ a", "ab"), "((a|b)^(a|b))");
  EXPECT_EQ(parsed("unused = a\n b", "ab"), "b");
}

TEST(CsgScript, LinesEndStatementsButNotInsideOne) {
  EXPECT_EQ(parsed("# c\n\n;x = (a\n\n- b)\r\n;;\ny = x |\n # d\n a\n\n", "ab"),
            "((a-b)|a)");
  EXPECT_EQ(parsed("\xef\xbb\xbf a", "a"), "a");
  EXPECT_EQ(parsed("translate(\n a |\n b\n,\n1,\n-2\n,+3\n)", "ab"),
            "moved0(a|b)");
}

TEST(CsgScript, FilesInQuotesAreOneNodeEach) {
  const Result<Script> script =
      parse_script("\"p q.off\" - 'it\"s.stl' & 'p q.off'");
  ASSERT_TRUE(script);
  EXPECT_EQ(shown(*script), "(p q.off-(it\"s.stl&p q.off))");
  EXPECT_EQ(script->files.size(), 2u);
  EXPECT_EQ(script->nodes[2].kind, NodeKind::kIntersection);
  EXPECT_EQ(script->nodes[2].place, (Place{1, 24}));
}

TEST(CsgScript, FunctionsMoveWhatTheyAreGiven) {
  const auto bindings = letters("a");
  const Result<Script> script = parse_script(
      "translate(scale(matrix(a, 1,0,0,5, 0,0,1,6, 0,-1,0,7), 0.5), 1e3, -.25,"
      " 0)",
      bindings);
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(shown(*script), "moved2moved1moved0a");
  const Matrix& given = script->transforms[0];
  EXPECT_EQ(given.rows[2][1], (io::Number{-1, 0, 0}));
  EXPECT_EQ(given.rows[1][3], io::number_of(6));
  EXPECT_EQ(script->transforms[1].rows[2][2], io::number_of(0.5));
  EXPECT_EQ(script->transforms[2].rows[0][3], io::number_of(1000));
  EXPECT_EQ(script->transforms[2].rows[1][3], io::number_of(-0.25));
}

TEST(CsgScript, HalvesHaveThreePointsThatShowWhereTheyFace) {
  const Result<Script> script =
      parse_script("'f' & half(y > -2.5) & half(0,0,0, 1,0,0, 0,1,0)");
  ASSERT_TRUE(script);
  ASSERT_EQ(script->halves.size(), 2u);
  const HalfSpace& half = script->halves[0];
  for (const Numbers3& point : half) EXPECT_EQ(point[1], io::number_of(-2.5));
  // Outwards, where the points go round counterclockwise, is towards -y: the
  // first step is along x, the second along z.
  EXPECT_EQ(half[1][0], io::number_of(1));
  EXPECT_EQ(half[2][2], io::number_of(1));
}

TEST(CsgScript, TroubleIsToldByLineAndColumn) {
  EXPECT_EQ(trouble("x = a |\n  b & q").message,
            "line 3, column 7: 'q' stands for nothing here");
  EXPECT_EQ(trouble("a - (b | c").message,
            "line 2, column 5: this bracket is never closed");
  EXPECT_EQ(trouble("a - b)").message,
            "line 2, column 6: this bracket was never opened");
  EXPECT_EQ(trouble("a b").message,
            "line 2, column 3: expected an operator, not 'b'");
  EXPECT_EQ(trouble("a -").message,
            "line 2, column 4: expected a solid, not the end");
  EXPECT_EQ(trouble("a - ;").message,
            "line 2, column 5: expected a solid, not ';'");
  EXPECT_EQ(trouble("translate(a)").message,
            "line 2, column 1: translate takes a solid and 3 numbers");
  EXPECT_EQ(trouble("rotate(a, 0, 0, 0, 5)").message,
            "line 2, column 1: the axis of this turn has no direction");
  EXPECT_EQ(trouble("a\nb").message,
            "line 2, column 1: only the last statement may do without "
            "`name =`");
  EXPECT_EQ(trouble("x = a = b").message,
            "line 2, column 7: expected an operator, not '='");
  EXPECT_EQ(trouble("a $ b").message,
            "line 2, column 3: nothing begins with '$'");
  EXPECT_EQ(trouble("\xc3\xa4").message,
            "line 2, column 1: nothing begins with the byte 0xc3");
  EXPECT_EQ(trouble("'half\n'").message,
            "line 2, column 1: these quotes do not end in their line");
  EXPECT_EQ(trouble("a -\n q").index, 3);
}

TEST(CsgScript, EveryTroubleHasItsCode) {
  const auto code = [](const std::string& text) { return trouble(text).code; };
  EXPECT_EQ(code("x = y; y = x"), ErrorCode::kBadIndex);
  EXPECT_EQ(code("half(x < 5"), ErrorCode::kSyntax);
  EXPECT_EQ(code("half(w < 5)"), ErrorCode::kSyntax);
  EXPECT_EQ(code("half(x & 5)"), ErrorCode::kBadIndex);
  EXPECT_EQ(code("half(1,2,3)"), ErrorCode::kSyntax);
  EXPECT_EQ(code("half(0,0,0, 1,1,1, 2,2,2)"), ErrorCode::kZeroArea);
  EXPECT_EQ(code("half = a"), ErrorCode::kSyntax);
  EXPECT_EQ(code("scale(a, 1, 2)"), ErrorCode::kSyntax);
  EXPECT_EQ(code("scale(a, 0)"), ErrorCode::kZeroArea);
  EXPECT_EQ(code("scale(a, 1e2000)"), ErrorCode::kOutOfRange);
  EXPECT_EQ(code("rotate(a, 1, 0, 0, 1e999)"), ErrorCode::kOutOfRange);
  EXPECT_EQ(code("matrix(a, 1,2,3,4, 2,4,6,8, 1,1,1,1)"), ErrorCode::kZeroArea);
  EXPECT_EQ(code("translate(a, 1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 3, 4)"),
            ErrorCode::kSyntax);
  EXPECT_EQ(code("translate(a, b, 2, 3)"), ErrorCode::kSyntax);
  EXPECT_EQ(code("translate(a, 1 2, 3)"), ErrorCode::kSyntax);
  EXPECT_EQ(code("(a, 1)"), ErrorCode::kSyntax);
  EXPECT_EQ(code("a, 1"), ErrorCode::kSyntax);
  EXPECT_EQ(code("''"), ErrorCode::kSyntax);
  EXPECT_EQ(parse_script("").error().code, ErrorCode::kEmpty);
  EXPECT_EQ(parse_script(" # nothing\n;\n").error().code, ErrorCode::kEmpty);
}

TEST(CsgScript, BindingsAreNamesAndUsed) {
  const auto code = [](const std::vector<Binding>& bindings) {
    const Result<Script> script = parse_script("a", bindings);
    return script ? std::string("fine") : script.error().message;
  };
  EXPECT_EQ(code({{"a", "f"}}), "fine");
  EXPECT_EQ(code({{"a", "f"}, {"b", "f"}}), "'b' is bound, but never used");
  EXPECT_EQ(code({{"a", "f"}, {"a", "f"}}), "'a' is bound twice");
  EXPECT_EQ(code({{"a", "f"}, {"1", "f"}}), "'1' is not a name");
  EXPECT_EQ(code({{"a", "f"}, {"half", "f"}}),
            "'half' is a function, not a name");
}

TEST(CsgScript, DepthCostsNoStack) {
  constexpr std::size_t kDepth = 100'000;
  const auto bindings = letters("a");
  const std::string open(kDepth, '(');
  const std::string close(kDepth, ')');
  EXPECT_TRUE(parse_script(open + "a" + close, bindings));
  EXPECT_EQ(parse_script(open, bindings).error().code, ErrorCode::kSyntax);
  EXPECT_EQ(parse_script(open + "a", bindings).error().message,
            "line 1, column 100000: this bracket is never closed");
  EXPECT_TRUE(parse_script(std::string(kDepth, '~') + "a", bindings));
  std::string right;
  for (std::size_t i = 0; i < kDepth; ++i) right += "a-(";
  const Result<Script> chain = parse_script(right + "a" + close, bindings);
  ASSERT_TRUE(chain);
  EXPECT_EQ(chain->nodes.size(), kDepth + 1);
}

}  // namespace
}  // namespace halfspace::csg
