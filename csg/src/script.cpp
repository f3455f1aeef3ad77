#include "halfspace/csg/script.hpp"

#include <utility>
#include <vector>

#include "compiler.hpp"
#include "machine.hpp"

namespace halfspace::csg {

Result<Script> parse_script(std::string_view text,
                            std::span<const Binding> bindings) {
  // Places and nodes are counted in 31 bits.
  if (text.size() >= std::size_t{1} << 31) {
    return Error{ErrorCode::kOutOfRange,
                 "a script must have fewer than 2^31 bytes", -1};
  }
  Script script;
  Compiler compiler(text);
  Machine machine(script, bindings);
  std::vector<OwnFunction> functions;
  const Result<Done> bound = machine.bind_names();
  if (!bound) return bound.error();
  std::optional<Value> last;
  Place place;
  while (true) {
    const Result<Statement> statement = compiler.next(functions);
    if (!statement) return statement.error();
    if (statement->kind == Statement::Kind::kEnd) break;
    if (statement->kind == Statement::Kind::kFunction) continue;
    Result<Value> value =
        machine.run(statement->code, statement->locals, functions);
    if (!value) return value.error();
    last = *std::move(value);
    place = statement->place;
    if (!statement->name.empty()) machine.name(statement->name, *last);
  }
  if (!last) return Error{ErrorCode::kEmpty, "there is no statement", -1};
  if (last->kind != Value::Kind::kSolid) {
    return error_at(place, ErrorCode::kSyntax,
                    "the last statement is the result, but it is no solid; "
                    "union(...) makes one of a list");
  }
  script.result = last->node;
  const Result<Done> used = machine.all_used();
  if (!used) return used.error();
  return script;
}

}  // namespace halfspace::csg
