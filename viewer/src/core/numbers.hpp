#pragma once

#include <memory>
#include <string>

#include "halfspace/io/load_scene.hpp"
#include "halfspace/viewer/model.hpp"

namespace halfspace::viewer {

/// The numbers that a look asks for, over a file that was loaded so that its
/// vertices are told apart.
/// Errors: those of io::read_scalars(), io::read_ply_scalars() and
///         io::scalars_of(); kEmpty (there is no number).
Result<std::shared_ptr<const Numbers>> numbers_of(const std::string& path,
                                                  const io::LoadedScene& loaded,
                                                  const ScalarLook& look);

}  // namespace halfspace::viewer
