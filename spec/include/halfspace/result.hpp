#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace halfspace {

/// What was wrong with an input. Which code a bad input gets is part of the
/// definition (S1), so that every implementation agrees on it.
enum class ErrorCode {
  kUnreadable,      ///< the file cannot be opened or read
  kUnwritable,      ///< the file cannot be created or written
  kUnknownFormat,   ///< the name or the first bytes name no format we read
  kSyntax,          ///< a token is not what the format asks for
  kTruncated,       ///< the input ends before the format says it may
  kNotFinite,       ///< a number is infinite or not a number
  kOutOfRange,      ///< a number or a count is beyond what the format allows
  kBadIndex,        ///< an index names nothing
  kTooFewVertices,  ///< a polygon has fewer than 3 vertices
  kRepeatedVertex,  ///< a polygon visits a point twice
  kZeroArea,        ///< all vertices of a polygon lie on one line
  kNotPlanar,       ///< a vertex lies off the polygon's plane
  kNotConvex,       ///< a polygon turns the wrong way, or more than once round
  kNotTriangle,     ///< a polygon with differing vertex colours has more than 3
  kBadCamera,       ///< the image plane passes through the eye, or is no plane
  kNotClosed,       ///< a solid's edges do not cancel in pairs
  kEmpty,           ///< there is nothing to work on
};

/// An error at the boundary: a code to test, a sentence to read, and where.
struct Error {
  ErrorCode code;
  /// One sentence without a final full stop; names the file and the line or
  /// element where there is one.
  std::string message;
  /// The index of the offending polygon, vertex, line or byte; -1 if none.
  std::int64_t index = -1;
};

/// A value, or the error that stands in its place.
///
/// The members are those of std::expected (C++23), no others.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// Requires: has_value().
  const T& value() const& { return std::get<0>(state_); }
  T& value() & { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  /// Requires: !has_value().
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success without a value.
struct Done {};

}  // namespace halfspace
