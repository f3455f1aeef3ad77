#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "code.hpp"
#include "halfspace/csg/script.hpp"

namespace halfspace::csg {

/// What an expression comes to: a number, a solid or a list.
struct Value {
  enum class Kind : std::uint8_t { kNumber, kSolid, kList } kind;
  io::Number number;
  std::int32_t node = -1;  ///< of the script
  std::shared_ptr<const std::vector<Value>> list;
  std::uint32_t depth = 0;  ///< of lists in lists
};

/// Runs the code of a script's statements and makes its nodes. No recursion:
/// calls and loops have stacks of their own.
class Machine {
 public:
  Machine(Script& script, std::span<const Binding> bindings)
      : script_(script), bindings_(bindings), used_(bindings.size()) {}

  /// Takes the bindings for names.
  /// Errors: kSyntax.
  Result<Done> bind_names();

  /// The value of a statement's code.
  /// Errors: those of parse_script().
  Result<Value> run(const Code& code, std::uint32_t locals,
                    const std::vector<OwnFunction>& functions);

  void name(std::string_view name, Value value) {
    names_.insert_or_assign(std::string(name), std::move(value));
  }

  /// Errors: kBadIndex (a binding that no code has loaded).
  Result<Done> all_used() const;

 private:
  struct Frame {
    const Code* code;
    std::size_t next;
    std::size_t first_local;  // of locals_
    std::size_t first_loop;
  };
  struct Loop {
    std::shared_ptr<const std::vector<Value>> list;
    std::size_t index = 0;
    std::vector<Value> made;
  };

  bool fail(const Place& place, ErrorCode code, const std::string& sentence) {
    error_ = error_at(place, code, sentence);
    return false;
  }
  bool fail(const Error& error) {
    error_ = error;
    return false;
  }
  Value pop();
  std::vector<Value> pop_many(std::size_t count);
  void push(io::Number number);
  void push_node(Node node);
  void push_combined(NodeKind kind, const Place& place, const Value& a,
                     const Value& b);
  bool push_list(std::vector<Value> values, const Place& place);
  bool step(const Instruction& at, const std::vector<OwnFunction>& functions);
  bool load(const Instruction& at);
  bool arithmetic(const Instruction& at);
  bool combine(const Instruction& at);
  bool index(const Instruction& at);
  bool enter(const Instruction& at, const OwnFunction& function);
  bool begin_loop(const Instruction& at);
  bool next_of_loop(const Instruction& at);
  bool call(const Instruction& at);
  bool call_transform(const Instruction& at, std::vector<Value> values);
  bool call_combine(const Instruction& at, std::vector<Value> values);
  bool call_primitive(const Instruction& at,
                      const std::vector<io::Number>& numbers);
  bool call_range(const Instruction& at,
                  const std::vector<io::Number>& numbers);
  bool call_number(const Instruction& at,
                   const std::vector<io::Number>& numbers);
  bool call_flip(const Instruction& at, const std::vector<Value>& values);
  bool push_half(const Instruction& at, HalfSpace half);
  bool push_primitive(const Instruction& at, io::Mesh mesh);
  std::int32_t file_node(File file, const Place& place);

  Script& script_;
  std::span<const Binding> bindings_;
  std::vector<bool> used_;  // by binding
  std::map<std::string, Value, std::less<>> names_;
  std::map<std::string, std::size_t, std::less<>> bound_;  // to bindings
  std::map<std::pair<std::string, std::string>, std::int32_t> files_;
  std::vector<Value> stack_;
  std::vector<Value> locals_;
  std::vector<Loop> loops_;
  std::vector<Frame> frames_;
  std::size_t steps_ = 0;
  std::optional<Error> error_;
};

}  // namespace halfspace::csg
