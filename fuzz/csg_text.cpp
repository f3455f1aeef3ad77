#include "csg_text.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "halfspace/csg/lexer.hpp"

namespace halfspace::fuzz {
namespace {

using csg::HalfSpace;
using csg::Matrix;
using csg::Node;
using csg::NodeKind;
using csg::Script;
using io::Number;

/// The number, exactly: an integer times a power of ten.
std::string text_of(const Number& number) {
  const std::int32_t ten = std::min({number.two, number.five, 0});
  const io::Integer digits =
      (number.mantissa << static_cast<unsigned>(number.two - ten)) *
      pow(io::Integer(5), static_cast<unsigned>(number.five - ten));
  std::string text = digits.str();
  if (ten < 0) text += "e" + std::to_string(ten);
  return text;
}

template <class Numbers>
std::string listed(const Numbers& numbers) {
  std::string text;
  for (const Number& number : numbers) text += ", " + text_of(number);
  return text;
}

/// `half(x < 5)`, for the half-spaces that such words make; else nine numbers.
std::string text_of(const HalfSpace& half) {
  const Number one{1, 0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool less : {false, true}) {
      HalfSpace wanted;
      for (auto& point : wanted) point[axis] = half[0][axis];
      wanted[less ? 1 : 2][(axis + 1) % 3] = one;
      wanted[less ? 2 : 1][(axis + 2) % 3] = one;
      if (wanted != half) continue;
      return std::string("half(") + "xyz"[axis] + (less ? " < " : " > ") +
             text_of(half[0][axis]) + ")";
    }
  }
  std::string numbers;
  for (const auto& point : half) numbers += listed(point);
  return "half(" + numbers.substr(2) + ")";
}

/// The call that moves `operand`, by the shortest function.
std::string call_of(const Matrix& matrix, const std::string& operand) {
  const auto& rows = matrix.rows;
  bool is_diagonal = true;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      is_diagonal = is_diagonal && (i == j || rows[i][j].mantissa == 0);
  }
  const std::array<Number, 3> scale = {rows[0][0], rows[1][1], rows[2][2]};
  const std::array<Number, 3> move = {rows[0][3], rows[1][3], rows[2][3]};
  const std::array<Number, 3> ones = {{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}};
  const bool is_uniform = scale[0] == scale[1] && scale[1] == scale[2];
  if (is_diagonal && scale == ones)
    return "translate(" + operand + listed(move) + ")";
  if (is_diagonal && move == std::array<Number, 3>{}) {
    return "scale(" + operand +
           (is_uniform ? ", " + text_of(scale[0]) : listed(scale)) + ")";
  }
  std::string numbers;
  for (const auto& row : rows) numbers += listed(row);
  return "matrix(" + operand + numbers + ")";
}

std::string text_of(const csg::File& file) {
  if (!file.name.empty()) return file.name;
  const char* quote = file.path.find('"') == std::string::npos ? "\"" : "'";
  return quote + file.path + quote;
}

char symbol_of(NodeKind kind) {
  switch (kind) {
    case NodeKind::kIntersection:
      return '&';
    case NodeKind::kDifference:
      return '-';
    case NodeKind::kSymmetricDifference:
      return '^';
    default:
      return '|';
  }
}

/// How strongly a node's operator holds its operands; 4: it needs no bracket.
int strength_of(NodeKind kind) {
  switch (kind) {
    case NodeKind::kUnion:
    case NodeKind::kDifference:
    case NodeKind::kSymmetricDifference:
      return 1;
    case NodeKind::kIntersection:
      return 2;
    case NodeKind::kComplement:
      return 3;
    default:
      return 4;
  }
}

template <class T>
const T& item_of(const std::vector<T>& items, const Node& node) {
  return items[static_cast<std::size_t>(node.item)];
}

/// A node whose operands are these texts.
std::string text_of(const Script& script, const Node& node,
                    const std::string& left, const std::string& right) {
  switch (node.kind) {
    case NodeKind::kFile:
      return text_of(item_of(script.files, node));
    case NodeKind::kHalf:
      return text_of(item_of(script.halves, node));
    case NodeKind::kTransform:
      return call_of(item_of(script.transforms, node), left);
    case NodeKind::kComplement:
      return "~" + left;
    default:
      return left + " " + symbol_of(node.kind) + " " + right;
  }
}

/// The same number for nodes that mean the same, in whatever script.
class Meanings {
 public:
  std::int32_t of_result(const Script& script) {
    std::vector<std::int32_t> ids;
    for (const Node& node : script.nodes) {
      const auto of = [&ids](std::int32_t id) {
        return id < 0 ? -1 : ids[static_cast<std::size_t>(id)];
      };
      std::string item;
      if (node.kind == NodeKind::kFile) {
        const csg::File& file = item_of(script.files, node);
        item = file.name + "\n" + file.path;
      } else if (node.item >= 0) {
        item = text_of(script, node, "", "");
      }
      const auto next = static_cast<std::int32_t>(ids_.size());
      ids.push_back(
          ids_.try_emplace({node.kind, of(node.left), of(node.right), item},
                           next)
              .first->second);
    }
    return ids[static_cast<std::size_t>(script.result)];
  }

 private:
  std::map<std::tuple<NodeKind, std::int32_t, std::int32_t, std::string>,
           std::int32_t>
      ids_;
};

}  // namespace

std::vector<csg::Binding> bindings_of(std::string_view text) {
  std::set<std::string_view> used;
  csg::Lexer lexer(text);
  for (auto token = lexer.next(); token && token->kind != csg::TokenKind::kEnd;
       token = lexer.next()) {
    if (token->kind == csg::TokenKind::kName) used.insert(token->text);
  }
  std::vector<csg::Binding> bindings;
  for (const char* name : {"a", "b", "c", "d"}) {
    if (used.contains(name))
      bindings.push_back({name, std::string(name) + ".off"});
  }
  return bindings;
}

std::string statements_of(const Script& script) {
  const auto name = [](std::int32_t id) { return "n" + std::to_string(id); };
  std::string text;
  for (std::size_t id = 0; id < script.nodes.size(); ++id) {
    const Node& node = script.nodes[id];
    text += name(static_cast<std::int32_t>(id)) + " = " +
            text_of(script, node, name(node.left), name(node.right)) + "\n";
  }
  return text + name(script.result);
}

std::optional<std::string> expression_of(const Script& script,
                                         std::size_t most) {
  std::vector<std::string> texts;
  for (const Node& node : script.nodes) {
    const int strength = strength_of(node.kind);
    const auto operand = [&](std::int32_t id, int least) {
      if (id < 0) return std::string();
      const std::string& text = texts[static_cast<std::size_t>(id)];
      const NodeKind kind = script.nodes[static_cast<std::size_t>(id)].kind;
      return least < 4 && strength_of(kind) < least ? "(" + text + ")" : text;
    };
    // Operators of one strength are done from left to right.
    texts.push_back(text_of(script, node, operand(node.left, strength),
                            operand(node.right, strength + 1)));
    if (texts.back().size() > most) return std::nullopt;
  }
  return texts[static_cast<std::size_t>(script.result)];
}

bool same_nodes(const Script& a, const Script& b) {
  const auto same_files = [](const auto& f, const auto& g) {
    return f.path == g.path && f.name == g.name;
  };
  const auto same = [](const Node& n, const Node& m) {
    return n.kind == m.kind && n.left == m.left && n.right == m.right &&
           n.item == m.item;
  };
  return a.result == b.result && a.halves == b.halves &&
         a.transforms == b.transforms &&
         std::equal(a.files.begin(), a.files.end(), b.files.begin(),
                    b.files.end(), same_files) &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(),
                    b.nodes.end(), same);
}

bool same_result(const Script& a, const Script& b) {
  Meanings meanings;
  return meanings.of_result(a) == meanings.of_result(b);
}

}  // namespace halfspace::fuzz
