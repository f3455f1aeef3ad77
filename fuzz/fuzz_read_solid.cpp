#include "fuzz.hpp"
#include "halfspace/fast/solid_data.hpp"
#include "halfspace/solid_file.hpp"

/// What is read from any bytes is written in both forms so that it reads back
/// the same. What becomes a solid keeps its data, and is an operand.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  const auto read = read_solid(fuzz::text_of(data, size));
  if (!read) {
    HALFSPACE_FUZZ_EXPECT(!read.error().message.empty());
    return 0;
  }
  for (const SolidForm form : {SolidForm::kBinary, SolidForm::kText}) {
    const auto again = read_solid(write_solid(*read, form));
    HALFSPACE_FUZZ_EXPECT(again.has_value() && *again == *read);
  }
  const auto solid = fast::to_solid(*read);
  if (!solid) {
    HALFSPACE_FUZZ_EXPECT(!solid.error().message.empty());
    return 0;
  }
  const SolidData written = fast::data_of(*solid, {"part"});
  HALFSPACE_FUZZ_EXPECT(check_solid_data(written).has_value());
  const auto same = fast::to_solid(written);
  HALFSPACE_FUZZ_EXPECT(same.has_value());
  // Polygons are now the numbers of the data's origins.
  SolidData again = fast::data_of(*same, {"part"});
  HALFSPACE_FUZZ_EXPECT(again.origins.size() == written.origins.size());
  again.origins = written.origins;
  HALFSPACE_FUZZ_EXPECT(again == written);
  return 0;
}
