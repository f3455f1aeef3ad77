#include <string>

#include "binding.hpp"

namespace halfspace::python {
namespace {

/// All codes, by their words: halfspace.ErrorCode has one member for each.
std::vector<std::string> error_codes() {
  std::vector<std::string> codes;
  for (int code = 0;; ++code) {
    const std::string_view words = to_string(static_cast<ErrorCode>(code));
    if (words == to_string(static_cast<ErrorCode>(-1))) return codes;
    codes.emplace_back(words);
  }
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Failure& failure) {
    const py::object error =
        py::module_::import("halfspace._errors")
            .attr("error_of")(std::string(to_string(failure.error.code)),
                              failure.error.message, failure.error.index);
    PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
  }
}

}  // namespace
}  // namespace halfspace::python

PYBIND11_MODULE(_core, module) {
  using namespace halfspace::python;
  module.doc() = "The library halfspace, bound name by name.";
  module.attr("VERSION") = HALFSPACE_VERSION;
  module.def("error_codes", &error_codes);
  py::register_exception_translator(&translate);
  bind_mesh(module);
  bind_solid(module);
  bind_display(module);
  bind_hidden(module);
  bind_map(module);
  bind_ref(module);
}
