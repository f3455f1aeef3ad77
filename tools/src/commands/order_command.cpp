#include <CLI/App.hpp>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/long_work.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/order_feed.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/io/picture.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

constexpr Word<FeedOrder> kOrderWords[] = {
    {"back-to-front", FeedOrder::kBackToFront},
    {"front-to-back", FeedOrder::kFrontToBack}};

struct OrderArguments {
  std::string path;
  std::string indices_file;
  std::optional<std::string> vertices_file;
  std::optional<std::string> polygons_file;
  FeedOrder order = FeedOrder::kBackToFront;
  std::optional<int> grid_bits;
  ViewArguments view;
};

/// A NumPy array of doubles of shape (rows, 3), little endian.
std::string npy_of(const fast::FragmentVertices& vertices, double step) {
  static_assert(std::endian::native == std::endian::little);
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(vertices.positions.size()) + ", 3), }";
  // The data begin at a multiple of 64 bytes, behind a line feed.
  constexpr std::size_t kBegin = 10;
  header.append(63 - (kBegin + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY\x01";
  bytes += '\0';
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;
  for (const auto& position : vertices.positions) {
    for (const double coordinate : position) {
      const double value = step * coordinate;
      char text[sizeof(double)];
      std::memcpy(text, &value, sizeof(double));
      bytes.append(text, sizeof(double));
    }
  }
  return bytes;
}

/// Rows of `columns` integers, as an array to write.
template <class Numbers>
ItemImage table_of(const Numbers& numbers, std::int32_t columns) {
  ItemImage table;
  table.width_px = columns;
  table.height_px = static_cast<std::int32_t>(numbers.size()) / columns;
  table.pixels.assign(numbers.begin(), numbers.end());
  return table;
}

Status write_files(const fast::FragmentVertices& vertices,
                   const std::vector<std::uint32_t>& indices,
                   const Scene& scene, const OrderArguments& arguments) {
  const Unit& unit = scene.unit();
  const double step =
      io::to_double({1, unit.exponent, unit.base == 10 ? unit.exponent : 0});
  note_part(arguments.indices_file);
  Result<Done> written =
      io::write_npy(arguments.indices_file, table_of(indices, 3));
  if (!written) return fail(arguments.indices_file, written.error());
  if (arguments.vertices_file) {
    note_part(*arguments.vertices_file);
    written = write_output(*arguments.vertices_file, npy_of(vertices, step));
    if (!written) return fail(*arguments.vertices_file, written.error());
  }
  if (arguments.polygons_file) {
    note_part(*arguments.polygons_file);
    written =
        io::write_npy(*arguments.polygons_file, table_of(vertices.polygons, 1));
    if (!written) return fail(*arguments.polygons_file, written.error());
  }
  return Status::kFine;
}

Status run_order(const OrderArguments& arguments) {
  const std::string wrong = complaint(
      std::array{NamedFile{"FILE", arguments.path}},
      std::array{
          NamedFile{"-o", arguments.indices_file},
          NamedFile{"--vertices", arguments.vertices_file.value_or("")},
          NamedFile{"--polygons", arguments.polygons_file.value_or("")}});
  if (!wrong.empty()) return fail(wrong);
  const Result<io::LoadedScene> loaded =
      load(arguments.path, import_options(arguments.view, arguments.grid_bits));
  if (!loaded) return fail(arguments.path, loaded.error());
  const Scene& scene = loaded->file.scene;
  const Result<ChosenCamera> chosen =
      choose_camera(loaded->file, arguments.view);
  if (!chosen) return fail(camera_error(arguments.path, chosen.error()));
  LongWork work("building the tree");
  fast::DisplayTreeOptions display;
  display.progress = [&work](double share) { return work.report(share); };
  fast::BspTree tree = fast::build_display_tree(scene, display);
  if (LongWork::interrupted()) return stop("interrupted");
  fast::divide_leaves(tree, scene);
  const fast::FragmentVertices vertices = fast::fragment_vertices(scene, tree);
  const std::vector<std::uint32_t> indices = fast::order_indices(
      scene, tree, vertices, chosen->camera, arguments.order);
  const Status written = write_files(vertices, indices, scene, arguments);
  if (written != Status::kFine) return written;
  say("{}: {} polygons; {} vertices, {} triangles {}\n", arguments.path,
      scene.polygon_count(), vertices.positions.size(), indices.size() / 3,
      word_of(kOrderWords, arguments.order));
  return Status::kFine;
}

}  // namespace

void add_order(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "order", "Put triangles in order for a renderer that blends");
  const auto arguments = std::make_shared<OrderArguments>();
  app->add_option("FILE", arguments->path, "A mesh or a .scene")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->indices_file,
                  "The triangles that the eye sees, in order: int32, three "
                  "vertices a row")
      ->required()
      ->type_name("FILE.npy");
  app->add_option("--vertices", arguments->vertices_file,
                  "The vertices, the same for every eye: float64, x y z a row")
      ->type_name("FILE.npy");
  app->add_option("--polygons", arguments->polygons_file,
                  "The polygon of each vertex: int32")
      ->type_name("FILE.npy");
  add_choice(*app, "--order", kOrderWords, arguments->order,
             "Back to front, which is usual, or front to back");
  add_grid_option(*app, arguments->grid_bits);
  add_view_options(*app, arguments->view);
  add_quiet_option(*app);
  app->footer(
      "Polygons that cross or overlap in a cycle are cut, so there is an "
      "order\n(S3.8).\n\n"
      "Example:\n"
      "  halfspace order part.stl -o order.npy --vertices vertices.npy --eye "
      "9,0,2");
  app->callback([arguments, &status] { status = run_order(*arguments); });
}

}  // namespace halfspace::tools
