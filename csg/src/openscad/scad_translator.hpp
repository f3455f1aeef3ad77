#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"
#include "scad_parser.hpp"

namespace halfspace::csg {

/// Makes a script's nodes of calls, from the inside out.
class ScadTranslator {
 public:
  ScadTranslator() : calls_(1) { calls_.front().name = "group"; }

  /// Whether a call is open.
  bool is_within() const { return calls_.size() > 1; }
  /// Opens a call, in the one that was opened last.
  std::optional<Error> open(ScadCall call);
  /// Makes a node of the call that was opened last. Requires: is_within().
  std::optional<Error> close();
  /// The script of all. Requires: !is_within(). Errors: kEmpty.
  Result<Script> script();

 private:
  /// The height of what is extruded.
  struct Extrusion {
    io::Number bottom, top;
  };

  bool fail(const Place& place, ErrorCode code, const std::string& sentence);
  bool wrong(const ScadCall& call, const std::string& wanted);
  bool finish(const ScadCall& call);
  bool shape(const ScadCall& call, std::int32_t& node);
  bool begin_extrusion(const ScadCall& call);
  bool transform(const ScadCall& call, std::int32_t& node);
  bool hull(const ScadCall& call, std::int32_t& node);
  bool corners_of(const ScadCall& call, std::vector<Numbers3>& corners);
  bool cube(const ScadCall& call, std::int32_t& node);
  bool sphere(const ScadCall& call, std::int32_t& node);
  bool cylinder(const ScadCall& call, std::int32_t& node);
  bool polyhedron(const ScadCall& call, std::int32_t& node);
  bool file(const ScadCall& call, std::int32_t& node);
  bool square(const ScadCall& call, std::int32_t& node);
  bool circle(const ScadCall& call, std::int32_t& node);
  bool polygon(const ScadCall& call, std::int32_t& node);
  bool prism(const ScadCall& call,
             const std::vector<std::array<io::Number, 2>>& points,
             std::int32_t& node);
  std::int32_t add(Node node);
  std::int32_t add_mesh(const ScadCall& call, io::Mesh mesh);
  std::int32_t joined(NodeKind kind, const ScadCall& call,
                      const std::vector<std::int32_t>& nodes);
  std::int32_t paired(const ScadCall& call, std::vector<std::int32_t> nodes);
  std::optional<std::size_t> fragments(const ScadCall& call,
                                       const io::Number& radius) const;

  Script script_;
  std::vector<ScadCall> calls_;
  std::vector<Extrusion> extrusions_;
  std::optional<Error> error_;
};

}  // namespace halfspace::csg
