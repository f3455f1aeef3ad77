// Checks what holds for the booleans of every two of the meshes that are named.

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "identities.hpp"
#include "placing.hpp"
#include "troubled_pairs.hpp"

namespace halfspace::identities {
namespace {

struct Model {
  std::string path;
  GridSolid solid;
  std::size_t size = 0;
};

/// The models that are closed and do not cross themselves, by their size.
std::vector<Model> usable(const std::vector<std::string>& paths,
                          std::size_t most) {
  std::vector<Model> models;
  for (const std::string& path : paths) {
    const Result<GridSolid> solid = load(path);
    if (!solid) {
      std::printf("left out: %s: %s\n", path.c_str(),
                  solid.error().message.c_str());
      continue;
    }
    const std::size_t size = solid->scene().polygon_count();
    if (size > most) {
      std::printf("left out: %s: %zu polygons\n", path.c_str(), size);
      continue;
    }
    const Result<Done> fine = fast::check_operand(fast::to_solid(*solid));
    if (!fine) {
      std::printf("left out: %s: %s\n", path.c_str(),
                  fine.error().message.c_str());
      continue;
    }
    models.push_back({path, *solid, size});
  }
  std::stable_sort(
      models.begin(), models.end(),
      [](const Model& a, const Model& b) { return a.size < b.size; });
  return models;
}

/// What is wrong with the pair in one position; nothing if it cannot be.
bool check(const Model& a, const Model& b, Position position,
           std::size_t& checked) {
  const auto pair = placed(a.solid, b.solid, position);
  if (!pair) return true;
  const fast::Solid first = fast::to_solid(pair->first, 0);
  const fast::Solid second = fast::to_solid(pair->second, first, 1);
  ++checked;
  const auto broken = broken_identities(first, second, shipped);
  for (const std::string& what : broken) {
    std::printf("WRONG: %s, %s, %s: %s\n", a.path.c_str(), b.path.c_str(),
                name_of(position), what.c_str());
  }
  return broken.empty();
}

/// What is wrong with made pairs, so many of each kind.
int run_made(std::uint64_t count, std::uint64_t seed) {
  std::size_t wrong = 0;
  for (const Trouble trouble : kTroubles) {
    agree::Draws draws(seed);
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto pair = troubled_pair(trouble, draws);
      const fast::Solid first = fast::to_solid(pair.first, 0);
      const fast::Solid second = fast::to_solid(pair.second, first, 1);
      const auto broken = broken_identities(first, second, shipped);
      for (const std::string& what : broken) {
        std::printf("WRONG: %s, pair %llu of seed %llu: %s\n", name_of(trouble),
                    static_cast<unsigned long long>(i),
                    static_cast<unsigned long long>(seed), what.c_str());
      }
      if (!broken.empty()) ++wrong;
    }
    std::printf("%s: %llu pairs\n", name_of(trouble),
                static_cast<unsigned long long>(count));
    std::fflush(stdout);
  }
  std::printf("%zu wrong\n", wrong);
  return wrong == 0 && count > 0 ? 0 : 1;
}

struct Bounds {
  std::size_t least = 0;  ///< polygons of the larger one
  std::size_t most = 100000;
  double seconds = 1e9;
};

int run(const std::vector<std::string>& paths, const Bounds& bounds) {
  const auto start = std::chrono::steady_clock::now();
  const auto models = usable(paths, bounds.most);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (std::size_t j = 0; j < models.size(); ++j) {
      if (std::max(models[i].size, models[j].size) >= bounds.least)
        pairs.emplace_back(i, j);
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [&](const auto& x, const auto& y) {
                     return models[x.first].size + models[x.second].size <
                            models[y.first].size + models[y.second].size;
                   });
  std::size_t checked = 0, wrong = 0, done = 0;
  for (const auto& [i, j] : pairs) {
    const std::chrono::duration<double> passed =
        std::chrono::steady_clock::now() - start;
    if (passed.count() > bounds.seconds) break;
    for (const Position position : kPositions)
      if (!check(models[i], models[j], position, checked)) ++wrong;
    ++done;
    if (done % 50 == 0) {
      std::printf("%zu pairs, up to %zu polygons together\n", done,
                  models[i].size + models[j].size);
    }
    std::fflush(stdout);
  }
  std::printf(
      "%zu models, %zu of %zu ordered pairs, %zu positions: %zu wrong\n",
      models.size(), done, pairs.size(), checked, wrong);
  return wrong == 0 && checked > 0 ? 0 : 1;
}

/// What the command line asks for.
struct Request {
  Bounds bounds;
  std::uint64_t made = 0, seed = 1;
  std::vector<std::string> paths;
};

/// Reads all of the text as a number that is not negative. Whether it is one.
template <class Number>
bool read_number(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && at == end && number >= 0;
}

/// Whether the words are right.
bool read_request(const std::vector<std::string>& words, Request& request) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.rfind("-", 0) != 0) {
      request.paths.push_back(word);
      continue;
    }
    if (++i == words.size()) return false;
    const bool good =
        word == "--min-polygons"   ? read_number(words[i], request.bounds.least)
        : word == "--max-polygons" ? read_number(words[i], request.bounds.most)
        : word == "--seconds" ? read_number(words[i], request.bounds.seconds)
        : word == "--made"
            ? read_number(words[i], request.made)
            : word == "--seed" && read_number(words[i], request.seed);
    if (!good) return false;
  }
  return (request.made > 0) == request.paths.empty();
}

}  // namespace
}  // namespace halfspace::identities

int main(int argc, char** argv) {
  using namespace halfspace::identities;
  Request request;
  if (!read_request({argv + 1, argv + argc}, request)) {
    std::fprintf(
        stderr,
        "usage: check_identities [--min-polygons N] [--max-polygons N] "
        "[--seconds S] MESH...\n"
        "       check_identities --made N [--seed S]\n");
    return 2;
  }
  return request.made > 0 ? run_made(request.made, request.seed)
                          : run(request.paths, request.bounds);
}
