#include <optional>
#include <stdexcept>

#include "binding.hpp"

namespace halfspace::python {
namespace {

using Holder = std::shared_ptr<Mesh>;

/// The mesh of arrays: one copy of each, for the library keeps vectors.
Holder make_mesh(const ArrayOf<double>& vertices,
                 const ArrayOf<std::uint32_t>& first_corner,
                 const ArrayOf<std::int32_t>& corners,
                 const std::optional<ArrayOf<std::uint8_t>>& colors,
                 const std::optional<ArrayOf<std::int32_t>>& materials,
                 const std::optional<ArrayOf<double>>& fields) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = rows_of<Point>(vertices, "vertices");
  mesh->first_corner = rows_of<std::uint32_t>(first_corner, "first_corner");
  mesh->corners = rows_of<std::int32_t>(corners, "corners");
  if (colors) mesh->colors = rows_of<Rgb>(*colors, "colors");
  if (materials)
    mesh->materials = rows_of<std::int32_t>(*materials, "materials");
  if (fields) {
    if (fields->ndim() != 2)
      throw std::invalid_argument("fields are not one row a corner");
    mesh->field_count = static_cast<std::size_t>(fields->shape(1));
    mesh->fields.assign(fields->data(), fields->data() + fields->size());
  }
  return mesh;
}

/// Binds an array of the mesh as an attribute: a view that keeps the mesh.
template <class Element, class T>
void def_array(py::class_<Mesh, Holder>& type, const char* name,
               std::vector<T> Mesh::*member) {
  type.def_property_readonly(name, [member](const py::object& self) {
    const std::vector<T>& values = self.cast<const Mesh&>().*member;
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size())};
    if (sizeof(T) > sizeof(Element))
      shape.push_back(static_cast<py::ssize_t>(sizeof(T) / sizeof(Element)));
    return view_of(reinterpret_cast<const Element*>(values.data()),
                   std::move(shape), self);
  });
}

}  // namespace

void bind_mesh(py::module_& module) {
  static_assert(sizeof(Point) == 3 * sizeof(double));
  static_assert(sizeof(Rgb) == 3 && sizeof(Origin) == 8);
  py::class_<Mesh, Holder> type(module, "Mesh");
  def_array<double>(type, "vertices", &Mesh::vertices);
  def_array<std::uint32_t>(type, "first_corner", &Mesh::first_corner);
  def_array<std::int32_t>(type, "corners", &Mesh::corners);
  def_array<std::uint8_t>(type, "colors", &Mesh::colors);
  def_array<std::int32_t>(type, "materials", &Mesh::materials);
  def_array<std::int32_t>(type, "origins", &Mesh::origins);
  type.def_property_readonly("fields", [](const py::object& self) {
    const Mesh& mesh = self.cast<const Mesh&>();
    const auto columns = static_cast<py::ssize_t>(mesh.field_count);
    const auto rows =
        static_cast<py::ssize_t>(columns == 0 ? 0 : mesh.corners.size());
    return view_of(mesh.fields.data(), {rows, columns}, self);
  });
  type.def("__eq__", [](const Mesh& a, const Mesh& b) { return a == b; });
  type.attr("__hash__") = py::none();
  module.def("make_mesh", &make_mesh, py::arg("vertices"),
             py::arg("first_corner"), py::arg("corners"),
             py::arg("colors") = py::none(), py::arg("materials") = py::none(),
             py::arg("fields") = py::none());
}

}  // namespace halfspace::python
