#include "image/object_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <set>
#include <sstream>
#include <utility>

#include "cli/arguments.hpp"
#include "cli/loading.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/objects.hpp"

namespace halfspace::tools {
namespace {

/// A million lines and more.
constexpr std::uint64_t kMostObjectBytes = std::uint64_t{1} << 28;

/// What is read of a model before regions are on grids.
struct ReadModel {
  std::string name;
  ModelFile file;
  std::vector<std::pair<std::int32_t, io::RegionPoints>> objects;
};

/// The words of a line, without its comment.
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream tokens(line.substr(0, line.find('#')));
  return {std::istream_iterator<std::string>(tokens), {}};
}

/// Reads the lines.
class ObjectReader {
 public:
  ObjectReader(const std::string& path, const io::ImportOptions& options)
      : folder_(std::filesystem::path(path).parent_path()), options_(options) {}

  std::optional<Error> read(const std::string& text) {
    std::istringstream lines(text);
    std::vector<std::vector<std::string>> all;
    for (std::string content; std::getline(lines, content);) {
      all.push_back(words_of(content));
      if (all.back().size() > 4 && all.back()[3] == "in")
        owners_.insert(all.back()[4]);
    }
    bool has_head = false;
    for (const auto& words : all) {
      ++line_;
      if (words.empty()) continue;
      if (!has_head) {
        if (words != std::vector<std::string>{"halfspace-objects", "1"})
          return wrong("begins with halfspace-objects 1");
        has_head = true;
        continue;
      }
      if (auto error = read_line(words)) return error;
    }
    if (!has_head) {
      line_ = 1;
      return wrong("begins with halfspace-objects 1");
    }
    if (models_.empty()) return wrong("has no world");
    return std::nullopt;
  }

  Result<ObjectFile> finish() {
    std::vector<Model> models;
    for (ReadModel& read : models_) {
      Result<Model> model =
          io::model_on_grid(read.file.loaded.file.scene, read.objects);
      if (!model) {
        Error error = model.error();
        error.message = "model " + read.name + ": " + error.message;
        return error;
      }
      models.push_back(*std::move(model));
      file_.files.push_back(std::move(read.file));
    }
    Result<Assembly> assembly = make_assembly(std::move(models));
    if (!assembly) {
      Error error = assembly.error();
      error.message = with_object_names(error.message, file_);
      return error;
    }
    file_.assembly = *std::move(assembly);
    file_.files[0].loaded.file.scene = file_.assembly.models()[0].scene;
    file_.most_shift = io::most_shift(file_.assembly);
    return std::move(file_);
  }

 private:
  Error wrong(const std::string& what) const {
    return {ErrorCode::kSyntax, "line " + std::to_string(line_) + ": " + what,
            line_};
  }

  std::optional<std::size_t> model_of(const std::string& name) const {
    for (std::size_t m = 0; m < models_.size(); ++m) {
      if (models_[m].name == name) return m;
    }
    return std::nullopt;
  }

  std::optional<Error> read_line(const std::vector<std::string>& words) {
    if (words[0] == "cut" && words.size() == 1) {
      file_.cut = true;
      return std::nullopt;
    }
    if (words[0] == "world" && words.size() == 2 && models_.empty())
      return read_model("world", words[1]);
    if (words[0] == "model" && words.size() == 3 && !models_.empty()) {
      if (model_of(words[1])) return wrong("has a second model " + words[1]);
      return read_model(words[1], words[2]);
    }
    if (words[0] == "object") return read_object(words);
    return wrong(
        "is `world FILE` first, then `model NAME FILE`, `object NAME MODEL "
        "[in MODEL] region X,Y,Z X,Y,Z [X,Y,Z ...] ...` or `cut`");
  }

  std::optional<Error> read_model(const std::string& name,
                                  const std::string& file) {
    std::string path = (folder_ / file).string();
    io::ImportOptions options = options_;
    // The camera is on the world's grid, and regions on their owners'. Others
    // need none so fine, and their maps have more room.
    if (!models_.empty() && !owners_.contains(name)) options.refine_bits = 0;
    Result<io::LoadedScene> loaded = load(path, options);
    if (!loaded) return io::error_about(path, loaded.error());
    models_.push_back({name, {std::move(path), *std::move(loaded)}, {}});
    return std::nullopt;
  }

  std::optional<Error> read_object(const std::vector<std::string>& words) {
    if (words.size() < 6)
      return wrong("an object has a name, a model and a region");
    NamedObject object;
    object.name = words[1];
    if (object.name.find('.') != std::string::npos)
      return wrong("an object's name has no dot");
    for (const NamedObject& other : file_.objects) {
      if (other.name == object.name)
        return wrong("has a second object " + object.name);
    }
    const auto model = model_of(words[2]);
    if (!model) return wrong("there is no model " + words[2] + " above");
    std::size_t k = 3;
    if (words[k] == "in") {
      const auto owner = model_of(words[k + 1]);
      if (!owner) return wrong("there is no model " + words[k + 1] + " above");
      object.owner = *owner;
      k += 2;
    }
    if (k + 2 >= words.size() || words[k] != "region")
      return wrong("an object has region X,Y,Z X,Y,Z");
    io::RegionPoints region;
    for (++k; k < words.size(); ++k) {
      const auto point = parse_vector(words[k]);
      if (!point) break;
      region.push_back(*point);
    }
    if (region.size() < 2 || region.size() == 3) {
      return wrong(
          "a region is a box, X,Y,Z X,Y,Z, or at least 4 points of a hull, "
          "finite numbers");
    }
    for (; k < words.size(); k += 2) {
      const std::string value = k + 1 < words.size() ? words[k + 1] : "";
      const auto understood = set_stand(object.stand, words[k], value);
      if (!understood)
        return wrong("knows move, turn, scale and there, not " + words[k]);
      if (!*understood)
        return wrong(words[k] + " must be " + stand_value_of(words[k]) +
                     ", not '" + value + "'");
    }
    auto& owner = models_[object.owner];
    object.object = owner.objects.size();
    owner.objects.push_back(
        {static_cast<std::int32_t>(*model), std::move(region)});
    file_.objects.push_back(std::move(object));
    return std::nullopt;
  }

  std::filesystem::path folder_;
  const io::ImportOptions& options_;
  std::int64_t line_ = 0;
  std::set<std::string> owners_;  ///< models that have objects
  std::vector<ReadModel> models_;
  ObjectFile file_;
};

/// The map of a stand, from steps of `inner` to those of `outer`.
ObjectMap map_of(const Stand& stand, const Unit& inner, const Unit& outer,
                 int most_shift) {
  const double angle = stand.turn_deg * std::numbers::pi / 180;
  const double quarter = stand.turn_deg / 90;
  // Right angles are exact.
  const bool is_right = quarter == std::floor(quarter);
  const double c = is_right ? std::nearbyint(std::cos(angle)) : std::cos(angle);
  const double s = is_right ? std::nearbyint(std::sin(angle)) : std::sin(angle);
  const double length = glm::length(stand.axis);
  const glm::dvec3 a = length > 0 ? stand.axis / length : glm::dvec3(0, 0, 1);
  std::array<std::array<double, 4>, 3> rows = {
      {{c + a.x * a.x * (1 - c), a.x * a.y * (1 - c) - a.z * s,
        a.x * a.z * (1 - c) + a.y * s, stand.move.x},
       {a.y * a.x * (1 - c) + a.z * s, c + a.y * a.y * (1 - c),
        a.y * a.z * (1 - c) - a.x * s, stand.move.y},
       {a.z * a.x * (1 - c) - a.y * s, a.z * a.y * (1 - c) + a.x * s,
        c + a.z * a.z * (1 - c), stand.move.z}}};
  for (auto& row : rows) {
    for (std::size_t k = 0; k < 3; ++k) row[k] *= stand.scale;
  }
  return io::object_map(rows, inner, outer, most_shift);
}

}  // namespace

std::string with_object_names(std::string message, const ObjectFile& file) {
  for (const NamedObject& object : file.objects) {
    const std::string number = "object " + std::to_string(object.object) +
                               " of model " + std::to_string(object.owner);
    for (auto at = message.find(number); at != std::string::npos;
         at = message.find(number, at + object.name.size())) {
      const std::size_t end = at + number.size();
      // Of model 1, not of 12.
      if (end < message.size() && message[end] >= '0' && message[end] <= '9') {
        at = end;
        continue;
      }
      message.replace(at, number.size(), object.name);
    }
  }
  return message;
}

std::string stand_value_of(const std::string& word) {
  if (word == "move") return "X,Y,Z, three finite numbers";
  if (word == "turn") return "X,Y,Z,DEGREES, an axis and an angle";
  return word == "scale" ? "a finite number" : "yes or no";
}

std::optional<bool> set_stand(Stand& stand, const std::string& word,
                              const std::string& value) {
  if (word == "move") {
    const auto to = parse_vector(value);
    if (to) stand.move = *to;
    return to.has_value();
  }
  if (word == "turn") {
    const auto comma = value.rfind(',');
    if (comma == std::string::npos) return false;
    const auto axis = parse_vector(value.substr(0, comma));
    const auto degrees = parse_number<double>(value.substr(comma + 1));
    if (!axis || !degrees || *axis == glm::dvec3(0)) return false;
    stand.axis = *axis;
    stand.turn_deg = *degrees;
    return true;
  }
  if (word == "scale") {
    const auto scale = parse_number<double>(value);
    if (scale) stand.scale = *scale;
    return scale.has_value();
  }
  if (word == "there") {
    stand.is_there = value == "yes";
    return value == "yes" || value == "no";
  }
  return std::nullopt;
}

Stand between(const Stand& a, const Stand& b, double share) {
  const auto mixed = [share](double from, double to) {
    return from == to ? from : from + (to - from) * share;
  };
  const auto vector = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dvec3(mixed(from.x, to.x), mixed(from.y, to.y),
                      mixed(from.z, to.z));
  };
  return {vector(a.move, b.move), vector(a.axis, b.axis),
          mixed(a.turn_deg, b.turn_deg), mixed(a.scale, b.scale), a.is_there};
}

Result<ObjectFile> read_object_file(const std::string& path,
                                    const io::ImportOptions& options) {
  const Result<std::string> text = io::read_file(path, kMostObjectBytes);
  if (!text) return io::error_about(path, text.error());
  ObjectReader reader(path, options);
  if (const auto error = reader.read(*text))
    return io::error_about(path, *error);
  Result<ObjectFile> file = reader.finish();
  if (!file) return io::error_about(path, file.error());
  return file;
}

Pose pose_of(const ObjectFile& file, const std::vector<Stand>& stands) {
  Pose pose = empty_pose(file.assembly);
  for (std::size_t k = 0; k < stands.size(); ++k) {
    if (!stands[k].is_there) continue;
    const NamedObject& object = file.objects[k];
    const Model& owner = file.assembly.models()[object.owner];
    const Scene& inner =
        file.assembly.model(owner.objects[object.object].model).scene;
    pose.maps[object.owner][object.object] =
        map_of(stands[k], inner.unit(), owner.scene.unit(), file.most_shift);
  }
  return pose;
}

}  // namespace halfspace::tools
