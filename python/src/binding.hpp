#pragma once

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/halfspace.hpp"

/// What the sources of the Python module share: errors, the interpreter's lock,
/// and arrays over memory that is there.
namespace halfspace::python {

namespace py = pybind11;

/// An error on its way to Python, where it becomes halfspace.Error.
struct Failure {
  Error error;
};

/// The value of a result. Throws: Failure.
template <class T>
T value_of(Result<T> result) {
  if (!result) throw Failure{result.error()};
  return *std::move(result);
}

/// Calls `work` while other threads may run Python.
template <class Work>
auto without_lock(const Work& work) {
  const py::gil_scoped_release released;
  return work();
}

/// Progress for Python: calls `callback` if it is one, and stops the work where
/// that returns False or raises, or where a signal such as Ctrl-C has come.
class Watch {
 public:
  explicit Watch(py::object callback) : callback_(std::move(callback)) {}
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// What the library calls, without the interpreter's lock. Valid as long as
  /// this object.
  Progress progress() {
    return [this](double share) { return goes_on(share); };
  }
  /// Requires: the interpreter's lock. Throws: what the callback raised.
  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  bool goes_on(double share) {
    const py::gil_scoped_acquire acquired;
    if (raised_) return false;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (callback_.is_none()) return true;
      const py::object answer = callback_(share);
      return answer.ptr() != Py_False;
    } catch (...) {
      raised_ = std::current_exception();
      return false;
    }
  }

  py::object callback_;
  std::exception_ptr raised_;
};

/// Three numbers, as any sequence of Python gives them.
using Triple = std::array<double, 3>;
inline Point point_of(const Triple& t) { return {t[0], t[1], t[2]}; }
inline Triple triple_of(const Point& p) { return {p.x, p.y, p.z}; }

/// A read-only array over memory that `owner` keeps: nothing is copied.
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape,
                  py::handle owner) {
  py::array_t<T> array(std::move(shape), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The vector as an array, which owns it from now on. `Element` is what the
/// array has in place of `T`: a struct of three doubles is a row of three.
template <class Element, class T>
py::array array_of(std::vector<T> values) {
  constexpr std::size_t kColumns = sizeof(T) / sizeof(Element);
  static_assert(sizeof(T) == kColumns * sizeof(Element));
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  const auto rows = static_cast<py::ssize_t>(owned->size());
  const auto* data = reinterpret_cast<const Element*>(owned->data());
  const py::capsule owner(owned.get(), [](void* vector) {
    delete static_cast<std::vector<T>*>(vector);
  });
  static_cast<void>(owned.release());
  std::vector<py::ssize_t> shape{rows};
  if (kColumns > 1) shape.push_back(static_cast<py::ssize_t>(kColumns));
  return py::array_t<Element>(std::move(shape), data, owner);
}

/// An array of that type, row by row; converted, and so copied, only where it
/// is of another one.
template <class T>
using ArrayOf = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// The rows of an array. Throws: std::invalid_argument, if it has another
/// number of columns.
template <class T, class Element>
std::vector<T> rows_of(const ArrayOf<Element>& array, const char* name) {
  constexpr py::ssize_t kColumns = sizeof(T) / sizeof(Element);
  const bool fits = kColumns == 1
                        ? array.ndim() == 1
                        : array.ndim() == 2 && array.shape(1) == kColumns;
  if (!fits) {
    throw std::invalid_argument(std::string(name) + " has not " +
                                std::to_string(kColumns) + " columns");
  }
  const auto* data = reinterpret_cast<const T*>(array.data());
  return std::vector<T>(data, data + array.shape(0));
}

/// The view that an object with the attributes of halfspace.View describes, but
/// for its progress.
View view_from(const py::object& object);

/// The answer of `question` to a view of Python, whose progress is called.
template <class Question>
auto asked_of_view(const py::object& object, const Question& question) {
  Watch watch(object.attr("progress"));
  View view = view_from(object);
  view.progress = watch.progress();
  auto answer = without_lock([&] { return question(view); });
  watch.rethrow();
  return value_of(std::move(answer));
}

void bind_display(py::module_& module);
void bind_hidden(py::module_& module);
void bind_map(py::module_& module);
void bind_mesh(py::module_& module);
void bind_ref(py::module_& module);
void bind_solid(py::module_& module);

}  // namespace halfspace::python
