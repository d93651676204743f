// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <optional>
#include <string>

#include "shape_pipeline/micrographs/image_file.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {

GreyVolume read_image_slices(const std::filesystem::path& path, const std::vector<std::filesystem::path>& slices,
                             double memory_limit) {
  const auto text = [](const GreySlice& slice) {
    return std::to_string(slice.width) + " x " + std::to_string(slice.height) + " pixels of " +
           std::to_string(8 * slice.bytes) + " bits";
  };
  std::optional<SampleSink> sink;
  std::string first;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    const GreySlice slice = read_slice(slices[s]);
    if (s == 0) {
      first = text(slice);
      const SampleType type{slice.bytes, false, std::endian::native == std::endian::big};
      sink.emplace(path, std::array<int, 3>{slice.width, slice.height, static_cast<int>(slices.size())}, type,
                   memory_limit);
    }
    if (text(slice) != first)
      refuse_file(slices[s], "", "has " + text(slice) + ", the first slice " + first,
                  "give slices of one size and type");
    sink->store(sink->grid().index(0, 0, static_cast<int>(s)), slice.samples);
  }
  return sink->finished();
}

}  // namespace shape_pipeline
