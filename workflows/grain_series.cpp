// SPDX-License-Identifier: GPL-3.0-or-later
#include "workflows/grain_series.h"

#include <map>

#include "catalog/input_error.h"
#include "workflows/digitize_batch.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

/// "stack_0006 to stack_0008"
std::string range_text(const std::vector<std::string>& names) {
  return names.size() == 1 ? names.front() : names.front() + " to " + names.back();
}

}  // namespace

std::string GrainSeries::name(std::size_t number) const { return stem + formatted("_%0*zu", digits, number); }

void remove_stale_grains(catalog::ShapeCatalog& catalog, const GrainSeries& series, std::size_t count,
                         const catalog::Provenance& provenance, BatchProgress& progress) {
  std::map<std::string, std::string> rejected;  // name to source
  for (const catalog::RejectedInput& input : catalog.rejected()) rejected[input.name] = input.source_file;
  std::vector<std::string> removed, foreign;
  const auto look_at = [&](const std::string& name, bool is_followed) {
    const auto id = catalog.find(name);
    if (const auto row = rejected.find(name); row != rejected.end() && row->second == provenance.source_file)
      catalog.forget_rejected(name);
    if (!id) return;
    const catalog::Provenance known = catalog.shape(*id).provenance;
    if (known.source_file == provenance.source_file) {
      if (have_one_source(known, provenance) && is_followed) return;
      catalog.remove_shape(name);
      if (!is_followed) removed.push_back(name);
    } else if (!is_followed && count > 0) {
      foreign.push_back(name);
    }
  };
  if (count > 0) look_at(series.stem, false);
  for (std::size_t number = 1;; ++number) {
    const std::string name = series.name(number);
    if (!catalog.find(name) && !rejected.contains(name)) break;
    look_at(name, number <= count);
  }
  if (!removed.empty())
    progress.note(formatted("%s: %zu of an earlier run removed (%s)", series.stem.c_str(), removed.size(),
                            range_text(removed).c_str()));
  if (!foreign.empty())
    progress.note(formatted("%s: the catalogue keeps %s of another source; tell them apart by source_file",
                            series.stem.c_str(), range_text(foreign).c_str()));
}

std::string hash_if_readable(const std::vector<std::filesystem::path>& files) {
  try {
    return files.empty() ? "" : hash_of_files(files);
  } catch (const catalog::InputError&) {
    return "";
  }
}

}  // namespace workflows
