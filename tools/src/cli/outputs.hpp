#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/result.hpp"

namespace halfspace::tools {

/// A file of the command line, and the option that names it.
struct NamedFile {
  std::string option;
  std::string path;
};

/// What is wrong with writing the outputs: one is an input, under whatever
/// name, or another output. Empty if nothing is. Devices and pipes may be
/// written twice. Empty paths name nothing.
std::string complaint(std::span<const NamedFile> inputs,
                      std::span<const NamedFile> outputs);

/// Has `write` make a file whose name ends in `extension`, and copies that to
/// standard output.
/// Errors: those of `write`; kUnwritable.
Result<Done> write_through(
    const std::string& extension,
    const std::function<Result<Done>(const std::string& path)>& write);

/// Writes to the file, or for `-` to standard output.
/// Errors: those of io::write_file().
Result<Done> write_output(const std::string& path, std::string_view bytes);

}  // namespace halfspace::tools
