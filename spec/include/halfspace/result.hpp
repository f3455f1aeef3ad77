#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace halfspace {

/// The fault of an input. Which code a bad input gets is part of the
/// definition (S1), so that every implementation agrees on it.
///
/// Error::index counts, where it is not -1:
///   while a text is read     lines, from 1;
///   while bytes are read     bytes;
///   kSyntax, kTruncated      lines or bytes, as above;
///   kNotFinite               vertices; of a field's number corners;
///   kOutOfRange              vertices; where no grid holds operands, operands;
///   kBadIndex                corners of a mesh, polygons of a scene;
///   kTooFewVertices to
///   kNotTriangle             polygons;
///   kZeroArea, kOutOfRange   of a clip plane: clip planes;
///   kOpen                    of make_solid() how many edges are bad, else
///                            polygons;
///   kSelfCrossing, kInsideOut polygons.
/// The message says the same in words. Other codes have no index.
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
  kBadRay,          ///< a ray has no direction
  kOpen,            ///< a solid's edges do not cancel in pairs
  kSelfCrossing,    ///< a solid's surface passes through itself or winds twice
  kInsideOut,       ///< a solid's faces look inwards, or hold nothing
  kUnbounded,       ///< a solid reaches infinitely far
  kEmpty,           ///< there is nothing to work on
  kStopped,         ///< a callback stopped the work
};

/// A few words for the code, such as "open surface".
constexpr std::string_view to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUnreadable:
      return "unreadable file";
    case ErrorCode::kUnwritable:
      return "unwritable file";
    case ErrorCode::kUnknownFormat:
      return "unknown format";
    case ErrorCode::kSyntax:
      return "syntax error";
    case ErrorCode::kTruncated:
      return "truncated input";
    case ErrorCode::kNotFinite:
      return "number not finite";
    case ErrorCode::kOutOfRange:
      return "out of range";
    case ErrorCode::kBadIndex:
      return "bad index";
    case ErrorCode::kTooFewVertices:
      return "too few vertices";
    case ErrorCode::kRepeatedVertex:
      return "repeated vertex";
    case ErrorCode::kZeroArea:
      return "zero area";
    case ErrorCode::kNotPlanar:
      return "polygon not planar";
    case ErrorCode::kNotConvex:
      return "polygon not convex";
    case ErrorCode::kNotTriangle:
      return "polygon not a triangle";
    case ErrorCode::kBadCamera:
      return "bad camera";
    case ErrorCode::kBadRay:
      return "bad ray";
    case ErrorCode::kOpen:
      return "open surface";
    case ErrorCode::kSelfCrossing:
      return "surface crosses itself";
    case ErrorCode::kInsideOut:
      return "surface inside out";
    case ErrorCode::kUnbounded:
      return "unbounded solid";
    case ErrorCode::kEmpty:
      return "nothing there";
    case ErrorCode::kStopped:
      return "stopped";
  }
  return "unknown error";
}

/// An error at the boundary: a code to test, a sentence to read, and where.
struct Error {
  ErrorCode code;
  /// One sentence without a final full stop; names the file and the line or
  /// element where there is one.
  std::string message;
  /// Which polygon, vertex, line or byte it is: what is counted is said at
  /// ErrorCode. -1 where there is none.
  std::int64_t index = -1;
};

/// Stops the program where the value of a Result is used that has none: a bug
/// of the caller, who is given the error's message.
[[noreturn]] inline void stop_without_value(const Error& error) {
  const std::string_view code = to_string(error.code);
  std::fprintf(stderr,
               "halfspace: the value of a Result was used that holds an error "
               "(%.*s): %s\n",
               static_cast<int>(code.size()), code.data(),
               error.message.c_str());
  std::abort();
}

/// A value, or the error that stands in its place.
///
/// The members are those of std::expected (C++23), no others; but the value of
/// a Result that nobody keeps comes out as a value, not as a reference to what
/// is gone: `for (const Region& region : *solid.section(plane))` is right. What
/// `->` leads to is gone at the end of the statement.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// Requires: has_value(); without one the program stops with the message.
  const T& value() const& { return checked(), *std::get_if<0>(&state_); }
  T& value() & { return checked(), *std::get_if<0>(&state_); }
  T value() && { return checked(), std::move(*std::get_if<0>(&state_)); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  /// Requires: !has_value().
  const Error& error() const { return std::get<1>(state_); }

 private:
  void checked() const {
    if (const Error* error = std::get_if<1>(&state_))
      stop_without_value(*error);
  }

  std::variant<T, Error> state_;
};

/// Success without a value.
struct Done {};

}  // namespace halfspace
