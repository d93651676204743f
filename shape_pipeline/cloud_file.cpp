// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/cloud_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include "catalog/input_error.h"
#include "shape_pipeline/reading/pcd_file.h"
#include "shape_pipeline/reading/ply_file.h"
#include "shape_pipeline/reading/row_sample.h"
#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/reading/scan_extent.h"
#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr double kUnitNormalSlack = 0.05;  // a normal's length may differ from 1 by this: exporters round to few digits
constexpr double kUnitNormalShare =
    0.95;  // share of points whose normal must be a unit vector for the column to be one

SampledCloud read_text_rows(const std::filesystem::path& path, std::size_t limit) {
  const ScanBytes bytes(path);
  const std::string_view text = bytes.view();
  RowSample sample(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), limit);
  SampledCloud result;
  PointCloud& cloud = result.cloud;
  TextRows rows(text);
  std::vector<double> numbers;
  std::size_t width = 0;
  while (rows.next()) {
    numbers.clear();
    if (!append_numbers(rows.row(), numbers) || numbers.size() < 3)
      refuse_file(path, rows.place(), "expected 'x y z' or 'x y z nx ny nz', found " + excerpt(rows.row()),
                  "remove the line, or begin it with # if it is a heading");
    if (width == 0) width = numbers.size();
    if (numbers.size() != width)
      refuse_file(path, rows.place(),
                  "expected " + std::to_string(width) + " numbers as in the rows above, found " +
                      std::to_string(numbers.size()),
                  "the file may be truncated here; copy or export it again");
    if (!sample.keeps(result.total++)) continue;
    cloud.points.push_back({numbers[0], numbers[1], numbers[2]});
    if (width >= 6) cloud.normals.push_back({numbers[3], numbers[4], numbers[5]});
  }
  return result;
}

bool is_finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

std::size_t remove_nan_points(PointCloud& cloud) {
  PointCloud kept;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!is_finite(cloud.points[i])) continue;
    kept.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) kept.normals.push_back(cloud.normals[i]);
  }
  const std::size_t removed = cloud.points.size() - kept.points.size();
  cloud = std::move(kept);
  return removed;
}

/// Normalises the given normals; drops the column if it does not hold unit vectors.
bool normals_are_usable(PointCloud& cloud) {
  std::size_t unit_count = 0;
  for (const Point& normal : cloud.normals)
    if (is_finite(normal) && std::abs(norm(normal) - 1) <= kUnitNormalSlack) ++unit_count;
  if (static_cast<double>(unit_count) < kUnitNormalShare * static_cast<double>(cloud.normals.size())) return false;
  for (Point& normal : cloud.normals) normal = is_finite(normal) ? normalized(normal) : Point{};
  return true;
}

void note_what_was_left_out(CloudFile& file) {
  if (file.left_out_points > 0)
    file.notes.push_back({"subsampled_points", true, static_cast<double>(file.left_out_points),
                          "points of a very large file left out: one in each run of them is kept, at random"});
  if (file.dropped_nan_points > 0)
    file.notes.push_back({"dropped_nan_points", true, static_cast<double>(file.dropped_nan_points),
                          "points with a coordinate that is no number dropped"});
  if (file.had_unusable_normals)
    file.notes.push_back({"given_normals", false, 0, "the normal columns hold no unit vectors: estimated instead"});
}

}  // namespace

CloudFile read_cloud(const std::filesystem::path& path, const CloudReading& reading) {
  CloudFile file;
  SampledCloud read;
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".ply") {
    PlyContents contents = read_ply(path, reading.point_limit);
    read = {{std::move(contents.points), std::move(contents.normals)}, contents.vertex_count};
  } else if (ending == ".pcd") {
    read = read_pcd(path, reading.point_limit);
  } else {
    read = read_text_rows(path, reading.point_limit);
  }

  file.cloud = std::move(read.cloud);
  const std::size_t total = file.cloud.points.size();
  file.left_out_points = read.total - total;
  file.dropped_nan_points = remove_nan_points(file.cloud);
  if (file.dropped_nan_points > 0 && !reading.drops_nan_points)
    refuse_file(path, "points",
                std::to_string(file.dropped_nan_points) + " of " + std::to_string(total) +
                    " points have a coordinate that is no number (NaN or infinite)",
                "clean the cloud, or drop these points with --drop-nan");
  if (file.cloud.points.size() < reading.smallest_count)
    refuse_file(path, "points",
                "expected at least " + std::to_string(reading.smallest_count) + " points, found " +
                    std::to_string(file.cloud.points.size()),
                "scan the particle more densely");
  if (file.cloud.has_normals() && !normals_are_usable(file.cloud)) {
    file.cloud.normals.clear();
    file.had_unusable_normals = true;
  }
  note_what_was_left_out(file);
  refuse_flat_scan(path, file.cloud.points);
  for (Point& point : file.cloud.points) point = scaled(point, reading.metres_per_unit);
  refuse_impossible_size(path, file.cloud.points);
  return file;
}

void write_cloud(const std::filesystem::path& path, const PointCloud& cloud) {
  static_assert(std::endian::native == std::endian::little, "the PLY header says little_endian");
  std::filesystem::path beside = path;
  beside += ".part";
  {
    std::ofstream stream(beside, std::ios::binary);
    stream << "ply\nformat binary_little_endian 1.0\ncomment unit m\nelement vertex " << cloud.points.size() << '\n';
    for (const char* name : {"x", "y", "z"}) stream << "property double " << name << '\n';
    if (cloud.has_normals())
      for (const char* name : {"nx", "ny", "nz"}) stream << "property double " << name << '\n';
    stream << "end_header\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      stream.write(reinterpret_cast<const char*>(cloud.points[i].data()), sizeof(Point));
      if (cloud.has_normals()) stream.write(reinterpret_cast<const char*>(cloud.normals[i].data()), sizeof(Point));
    }
    if (!stream.flush()) refuse_file(path, "", "cannot be written", "check the folder and the space on the disk");
  }
  std::filesystem::rename(beside, path);
}

}  // namespace shape_pipeline
