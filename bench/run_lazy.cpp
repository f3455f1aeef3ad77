#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "papers/table.hpp"
#include "random_rays.hpp"
#include "timing.hpp"
#include "workloads.hpp"

/// How long the first picture takes, and those of all sides, by a tree that is
/// built at once and by one that is built as it is looked at (S3.12).
namespace halfspace::bench {
namespace {

constexpr View kSides[] = {View::kFront, View::kBack, View::kLeft,
                           View::kRight, View::kTop,  View::kBottom};

struct Request {
  int threads = 1;
  int repeats = 3;
  std::int32_t size_px = 1500;
  bool moves = false;
  bool rays = false;
  std::vector<std::string> only;
  std::vector<std::string> meshes;
};

/// Milliseconds, the least of some runs each.
struct Times {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double open = kNone;
  double first = kNone;  ///< with the opening
  double all = kNone;    ///< with that, and pictures of all sides
  double again = kNone;  ///< the first picture once more
};

class Comparison {
 public:
  explicit Comparison(const Request& request) : request_(request) {
    table_.head = {"scene",   "polygons", "built at once, ms", "first picture",
                   "all six", "again",    "opened, ms",        "first picture",
                   "all six", "again",    "built by one"};
  }

  void add(const std::string& name, const Scene& scene,
           const std::vector<Camera>& cameras) {
    std::fprintf(stderr, "%s ...\n", name.c_str());
    Times eager;
    Times lazy;
    std::size_t built = 0;
    fast::RenderOptions how;
    how.threads = request_.threads;
    how.items = false;
    fast::DisplayTreeOptions options;
    options.threads = request_.threads;
    for (int k = 0; k < request_.repeats; ++k) {
      take(
          eager, cameras,
          [&] { return fast::build_display_tree(scene, options); },
          [&](const fast::BspTree& tree, const Camera& camera) {
            (void)fast::render(scene, tree, camera, {}, how);
          },
          [](const fast::BspTree&) {});
      take(
          lazy, cameras,
          [&] { return fast::LazyTree(scene, {.tree = options}); },
          [&](const fast::LazyTree& tree, const Camera& camera) {
            (void)fast::render(tree, camera, {}, how);
          },
          [&](const fast::LazyTree& tree) {
            built = tree.stats().polygons_built;
          });
    }
    table_.rows.push_back(
        {name, std::to_string(scene.polygon_count()), digits(eager.open),
         digits(eager.first), digits(eager.all), digits(eager.again),
         digits(lazy.open), digits(lazy.first), digits(lazy.all),
         digits(lazy.again), std::to_string(built)});
  }

  void print() const {
    std::printf("%d threads, %s, least of %d; %d x %d pixels.\n\n%s",
                request_.threads,
                request_.threads == 1 ? "processor time" : "time on the wall",
                request_.repeats, request_.size_px, request_.size_px,
                to_markdown(table_).c_str());
  }

 private:
  double now() const {
    return request_.threads == 1 ? process_ms() : wall_ms();
  }

  template <class Open, class Draw, class AfterFirst>
  void take(Times& times, const std::vector<Camera>& cameras, Open open,
            Draw draw, AfterFirst after_first) const {
    double spent = 0;
    const auto timed = [&](auto&& work) {
      const double start = now();
      work();
      const double took = now() - start;
      spent += took;
      return took;
    };
    const double start = now();
    const auto tree = open();
    spent = now() - start;
    times.open = std::min(times.open, spent);
    timed([&] { draw(tree, cameras.front()); });
    times.first = std::min(times.first, spent);
    after_first(tree);
    for (std::size_t k = 1; k < cameras.size(); ++k)
      timed([&] { draw(tree, cameras[k]); });
    times.all = std::min(times.all, spent);
    times.again =
        std::min(times.again, timed([&] { draw(tree, cameras.front()); }));
  }

  Request request_;
  Table table_;
};

/// The scene with polygons in another place, evenly strewn among all.
Scene with_moved(const Scene& scene, const std::vector<PolygonId>& polygons) {
  SceneData data = scene.data();
  for (const PolygonId polygon : polygons) {
    for (const VertexId v : scene.corners(polygon)) {
      GridPoint& p = data.vertices[static_cast<std::size_t>(v)];
      p = {p.x + 37, p.y - 29, p.z + 31};
    }
  }
  Result<Scene> made = make_scene(std::move(data));
  if (!made) {
    std::fprintf(stderr, "%s\n", made.error().message.c_str());
    std::exit(2);
  }
  return *std::move(made);
}

/// What it takes when few polygons move: of scenes whose polygons share no
/// vertices.
void add_moves(const Request& request, const std::string& name,
               const Scene& scene, const Camera& camera, Table& table) {
  if (scene.data().vertices.size() != scene.data().corners.size()) return;
  fast::RenderOptions how;
  how.threads = request.threads;
  how.items = false;
  fast::DisplayTreeOptions options;
  options.threads = request.threads;
  const auto took = [](auto&& work) {
    const double start = process_ms();
    work();
    return process_ms() - start;
  };
  for (const std::size_t count : {std::size_t{10}, std::size_t{1000}}) {
    if (count > scene.polygon_count()) continue;
    std::vector<PolygonId> polygons;
    for (std::size_t k = 0; k < count; ++k) {
      polygons.push_back(
          static_cast<PolygonId>(k * scene.polygon_count() / count));
    }
    fast::LazyTree tree(scene, {.tree = options});
    (void)fast::render(tree, camera, {}, how);
    Scene next;
    const double check = took([&] { next = with_moved(scene, polygons); });
    const double move = took([&] { tree.move_to(next, polygons); });
    const double frame =
        took([&] { (void)fast::render(tree, camera, {}, how); });
    const double again =
        took([&] { (void)fast::render(tree, camera, {}, how); });
    const double reopened = took([&] {
      (void)fast::render(fast::LazyTree(next, {.tree = options}), camera, {},
                         how);
    });
    const double anew = took([&] {
      (void)fast::render(next, fast::build_display_tree(next, options), camera,
                         {}, how);
    });
    table.rows.push_back({name, std::to_string(count), digits(check),
                          digits(move), digits(frame), digits(again),
                          digits(reopened), digits(anew)});
  }
}

/// What the first ray takes, with the tree, and many of them after it.
void add_rays(const Request& request, const std::string& name,
              const Scene& scene, Table& table) {
  constexpr std::size_t kMany = 100'000;
  const std::vector<Ray> rays = random_rays(scene, extent_of(scene), kMany, 1);
  fast::DisplayTreeOptions options;
  options.threads = request.threads;
  struct Spent {
    double first = Times::kNone;
    double thousand = Times::kNone;
    double many = Times::kNone;
    double again = Times::kNone;
  };
  const auto take = [&](Spent& spent, auto&& open, auto&& ask) {
    const double start = process_ms();
    const auto tree = open();
    std::size_t r = 0;
    const auto until = [&](std::size_t end) {
      for (; r < end; ++r) ask(tree, rays[r]);
      return process_ms() - start;
    };
    spent.first = std::min(spent.first, until(1));
    spent.thousand = std::min(spent.thousand, until(1000));
    const double all = until(kMany);
    spent.many = std::min(spent.many, all);
    r = 0;
    spent.again = std::min(spent.again, until(kMany) - all);
  };
  Spent eager;
  Spent lazy;
  for (int k = 0; k < request.repeats; ++k) {
    take(
        eager, [&] { return fast::build_display_tree(scene, options); },
        [&](const fast::BspTree& tree, const Ray& ray) {
          (void)fast::first_hit(scene, tree, ray);
        });
    take(
        lazy, [&] { return fast::LazyTree(scene, {.tree = options}); },
        [&](const fast::LazyTree& tree, const Ray& ray) {
          (void)fast::first_hit(tree, ray);
        });
  }
  const fast::LazyTree one(scene, {.tree = options});
  (void)fast::first_hit(one, rays.front());
  table.rows.push_back(
      {name, std::to_string(scene.polygon_count()), digits(eager.first),
       digits(eager.thousand), digits(eager.many), digits(eager.again),
       digits(lazy.first), digits(lazy.thousand), digits(lazy.many),
       digits(lazy.again), std::to_string(one.stats().polygons_built)});
}

int run(const Request& request) {
  Comparison comparison(request);
  Table rays;
  rays.head = {"scene",           "polygons",    "built at once, one ray, ms",
               "1,000",           "100,000",     "again",
               "opened, one ray", "1,000",       "100,000",
               "again",           "built by one"};
  Table moves;
  moves.head = {"scene", "moved", "scene, ms",   "move_to, ms",
                "frame", "again", "opened anew", "built anew"};
  const auto wants = [&](const std::string& name) {
    return request.meshes.empty() && request.only.empty()
               ? true
               : std::any_of(request.only.begin(), request.only.end(),
                             [&](const std::string& part) {
                               return name.find(part) != std::string::npos;
                             });
  };
  for (const Workload& workload : workloads(1)) {
    if (!wants(workload.name)) continue;
    const Result<Scene> scene = workload.scene();
    if (!scene) return 2;
    std::vector<Camera> cameras;
    for (const View side : kSides)
      cameras.push_back(workload.camera(*scene, side, request.size_px));
    if (request.rays) {
      add_rays(request, workload.name, *scene, rays);
      continue;
    }
    comparison.add(workload.name, *scene, cameras);
    if (request.moves)
      add_moves(request, workload.name, *scene, cameras.front(), moves);
  }
  for (const std::string& path : request.meshes) {
    const Result<io::Mesh> mesh = io::read_mesh(path);
    if (!mesh) {
      std::fprintf(stderr, "%s: %s\n", path.c_str(),
                   mesh.error().message.c_str());
      return 2;
    }
    const Result<io::Imported> made = io::import_scene(*mesh, {});
    if (!made) return 2;
    if (request.rays) {
      add_rays(request, path, made->scene, rays);
      continue;
    }
    std::vector<Camera> cameras;
    for (const View side : kSides)
      cameras.push_back(scene_camera(made->scene, side, request.size_px));
    comparison.add(path, made->scene, cameras);
  }
  if (request.rays) {
    std::printf("%s", to_markdown(rays).c_str());
    return 0;
  }
  comparison.print();
  if (request.moves) std::printf("\n%s", to_markdown(moves).c_str());
  return 0;
}

}  // namespace
}  // namespace halfspace::bench

int main(int argc, char** argv) {
  halfspace::bench::Request request;
  CLI::App app("First pictures by trees that are built at once, and lazily");
  app.add_option("--threads", request.threads, "Of builds and pictures")
      ->check(CLI::Range(1, 1024));
  app.add_option("--repeats", request.repeats, "Runs of each")
      ->check(CLI::PositiveNumber);
  app.add_option("--size", request.size_px, "Of pictures, in pixels")
      ->check(CLI::Range(1, 8000));
  app.add_flag("--moves", request.moves,
               "What it takes when 10 and 1,000 polygons move, too");
  app.add_flag("--rays", request.rays, "First hits of rays, no pictures");
  app.add_option("--only", request.only,
                 "Only workloads with one of these in their names");
  app.add_option("--mesh", request.meshes, "Files of meshes, instead");
  CLI11_PARSE(app, argc, argv);
  return halfspace::bench::run(request);
}
