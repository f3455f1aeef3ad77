#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/solid.hpp"
#include "halfspace/threads.hpp"

namespace halfspace::detail {

/// What stands at a leaf of an expression, once it is loaded.
struct LeafData {
  std::shared_ptr<const csg::Source> source;
  /// The polygons' properties; null if they have none.
  std::shared_ptr<const Mesh> properties;
  /// By vertex of those, its point exactly; empty where there are no fields.
  std::vector<csg::Numbers3> vertices;
  /// What these are made from: the doubles of `properties`, each as it is, or
  /// each as the short decimal that it stands for; or neither.
  enum class From : std::uint8_t { kDoubles, kShortDecimals, kOthers };
  From from = From::kOthers;
  /// What it is called in exact files; empty: by the solid's name.
  std::string part;
};

/// A leaf of an expression: made, or read, when it is first needed.
class Leaf {
 public:
  using Load = std::function<Result<LeafData>()>;
  explicit Leaf(Load load) : load_(std::move(load)) {}

  /// The data; the same at each call, from any thread.
  const Result<LeafData>& data() const {
    const Lock lock(mutex_);
    if (!data_) data_.emplace(load_());
    return *data_;
  }

 private:
  Load load_;
  mutable Mutex mutex_;
  mutable std::optional<Result<LeafData>> data_;
};

/// A solid that was worked out. `solid` and what it shares with others of one
/// table may be used by one thread at a time: hold `mutex` for that.
struct Evaluation {
  fast::Solid solid;
  /// By leaf of the plan: the operand, and how it was moved.
  struct Use {
    std::shared_ptr<const SolidNode> node;
    csg::Matrix matrix;
  };
  std::vector<Use> uses;
  /// By plane of the plan: the half-space, and points of the plane,
  /// counterclockwise as seen from outside: on the grid, and as they were said.
  struct Cut {
    std::shared_ptr<const SolidNode> node;
    std::array<GridPoint, 3> points;
    csg::HalfSpace said;
  };
  std::vector<Cut> cuts;
  RoundingReport rounding;
  Mutex mutex;
};

/// A node of an expression. Immutable, but for what it remembers.
struct SolidNode {
  csg::NodeKind kind = csg::NodeKind::kFile;
  std::shared_ptr<const SolidNode> left;
  std::shared_ptr<const SolidNode> right;
  std::shared_ptr<const Leaf> leaf;  ///< of kFile
  csg::HalfSpace half;               ///< of kHalf
  csg::Matrix matrix;                ///< of kTransform
  csg::Numbers3 point;               ///< of kComponent
  std::optional<Error> error;        ///< what was wrong with its making
  std::string name;

  SolidNode() = default;
  SolidNode(const SolidNode&) = delete;
  SolidNode& operator=(const SolidNode&) = delete;
  /// No recursion, however deep the expression is.
  ~SolidNode();

  static const SolidNode& of(const Solid& solid) { return *solid.node_; }
  static std::shared_ptr<const SolidNode> shared(const Solid& solid) {
    return solid.node_;
  }
  static Solid solid_of(std::shared_ptr<const SolidNode> node) {
    return Solid(std::move(node));
  }

  /// What the expression comes to; worked out once.
  Result<std::shared_ptr<Evaluation>> evaluation(
      const WorkOptions& options) const;
  /// What it comes to is known.
  void set_evaluation(std::shared_ptr<Evaluation> evaluation) const;

 private:
  mutable Mutex mutex_;
  mutable std::optional<Result<std::shared_ptr<Evaluation>>> evaluation_;
};

/// A leaf of that name.
Solid leaf_solid(std::string name, Leaf::Load load);

/// A solid that is the error.
Solid faulty_solid(std::string name, ErrorCode code, std::string message);

}  // namespace halfspace::detail
