// SPDX-License-Identifier: Apache-2.0
#include "workflows/scene_place.h"

#include <charconv>

namespace workflows {
namespace {

/// The fill or chain that a message about "body N" is about; empty for other messages.
std::string place_of_body(const std::string& message, const SceneDescription& description,
                          const AssembledScene& assembled) {
  constexpr std::string_view kBody = "body ";
  if (!message.starts_with(kBody)) return {};
  int body = -1;
  std::from_chars(message.data() + kBody.size(), message.data() + message.size(), body);
  for (std::size_t fill = 0; fill < assembled.fills.size(); ++fill)
    if (body >= assembled.fills[fill].first_body &&
        body < assembled.fills[fill].first_body + assembled.fills[fill].bodies)
      return description.fills[fill].place;
  for (std::size_t chain = 0; chain < assembled.chains.size(); ++chain)
    if (body >= assembled.chains[chain].first_body &&
        body < assembled.chains[chain].first_body + assembled.chains[chain].bodies)
      return description.chains[chain].place;
  return {};
}

/// The engine's message with its place in front. Messages that name the file stay as they are.
catalog::InputError placed(const catalog::InputError& error, const AssembledScene& assembled,
                           const SceneDescription& description) {
  const std::string message = error.what(), file = description.file.string();
  if (message.starts_with(file)) return error;
  std::string place = place_of_body(message, description, assembled);
  // The longest beginning is the last one.
  for (const auto& [beginning, its_place] : description.places)
    if (message.starts_with(beginning)) place = its_place;
  return catalog::InputError((place.empty() ? file : place) + ": " + message);
}

}  // namespace

void check_scene(const AssembledScene& assembled, const SceneDescription& description) {
  try {
    dem_gpu::check(assembled.scene);
  } catch (const catalog::InputError& error) {
    throw placed(error, assembled, description);
  }
}

dem_gpu::Simulation start_simulation(const AssembledScene& assembled, const SceneDescription& description) {
  try {
    return dem_gpu::Simulation(assembled.scene);
  } catch (const catalog::InputError& error) {
    throw placed(error, assembled, description);
  }
}

}  // namespace workflows
