#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/result.hpp"
#include "halfspace/shadow/boolean.hpp"

namespace halfspace::tools {

/// What the output `-` is called in messages.
inline constexpr const char* kOutputName = "standard output";

/// All that there is to tell of a boolean that was done.
struct CsgContext {
  const csg::Script& script;
  const csg::Plan& plan;
  const csg::Operands& operands;
  const csg::Outcome& result;
  /// The booleans that were checked, if they were to be.
  const std::optional<shadow::BooleanReport>& checks;
  double boolean_ms = 0;
};

/// Writes the result as the file's name says, exactly where the format can.
/// What the result's own rounding moved is in the report, too. `form`: of an
/// exact solid; `beside`: whether there may be a file of materials beside it.
/// Errors: those of write_mesh() and of import, for scenes; kUnwritable.
Result<io::ExportReport> write_result(const std::string& path,
                                      const csg::Outcome& result,
                                      SolidForm form = SolidForm::kBinary,
                                      bool beside = true);

/// Writes the origin of each polygon of the result as text. A line
/// `solid I NAME PATH` for each solid, as it was moved at a place in the
/// script; then, for each polygon in order, `I J`: it is a part of polygon `J`
/// of solid `I`, as its file counts them, from 0.
/// Errors: kUnwritable.
Result<Done> write_origins(const std::string& path, const CsgContext& context);

/// What is said where rounding lost something of the solid.
/// Requires: result.rounding.
std::string loss_sentence(const csg::Outcome& result);

/// Says what was passed over in a file.
void print_notes(const std::string& name, const io::Attributes& attributes);

/// Says what the output's format has no room for, if there is any.
void print_lost(const std::string& output,
                const std::vector<std::string>& lost);

/// Says what was not to be had for the output.
void print_notes(const std::string& output, const io::ExportReport& report);

/// What `--stats` says.
nlohmann::json stats_of(const CsgContext& context,
                        const io::ExportReport& report);

/// Says what was done, line by line, on standard output.
void print_summary(const CsgContext& context, const io::ExportReport& report,
                   const std::string& output);

}  // namespace halfspace::tools
