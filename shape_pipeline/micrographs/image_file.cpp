// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/image_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>

#include "catalog/input_error.h"

namespace shape_pipeline {
namespace {

namespace fs = std::filesystem;

constexpr int kLeastSide = 32;         // [pixels]
constexpr int kLargestPicture = 3200;  // [pixels] a side
constexpr char kKinds[] = "expected a PNG, JPEG, BMP or one-page TIFF of 8 or 16 bits";

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw catalog::InputError(path.string() + ": " + reason);
}

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
  if (!fs::is_regular_file(path)) refuse(path, "no such file; check the path");
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) refuse(path, "cannot be read; check its permissions");
  if (bytes.empty()) refuse(path, "is empty (0 bytes), " + std::string(kKinds) + "; save the image anew");
  return bytes;
}

/// The decoders take files that end early, too, and fill in what is missing.
void require_whole_image(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool is_png = text.starts_with("\x89PNG"), is_jpeg = text.starts_with("\xff\xd8");
  // The decoders go by content, and there are some for kinds that nobody asked for.
  const bool is_tiff = text.starts_with(std::string_view("II*\0", 4)) || text.starts_with(std::string_view("MM\0*", 4));
  if (!is_png && !is_jpeg && !is_tiff && !text.starts_with("BM"))
    refuse(path, "is damaged or of another kind, " + std::string(kKinds) + "; save it anew");
  if ((is_png && text.find("IEND") == text.npos) || (is_jpeg && text.rfind("\xff\xd9") == text.npos))
    refuse(path, "ends before its last pixels do (truncated " + std::string(is_png ? "PNG" : "JPEG") +
                     "); copy or save it anew");
}

cv::Mat decoded(const fs::path& path) {
  const std::vector<std::uint8_t> bytes = bytes_of(path);
  require_whole_image(path, bytes);
  cv::Mat image;
  try {
    if (const bool is_tiff = bytes.size() > 2 && bytes[0] == bytes[1] && (bytes[0] == 'I' || bytes[0] == 'M');
        is_tiff && cv::imcount(path.string()) > 1)
      refuse(path,
             "has several pages, " + std::string(kKinds) + "; save the page that is meant, or give a stack --voxel");
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    refuse(path, "cannot be decoded (" + error.err + "), " + kKinds + "; save it anew");
  }
  if (image.empty()) refuse(path, "is damaged or of another kind, " + std::string(kKinds) + "; save it anew");
  return image;
}

cv::Mat grey_of(const fs::path& path, const cv::Mat& image) {
  if (image.depth() != CV_8U && image.depth() != CV_16U)
    refuse(path, "holds neither 8 nor 16 unsigned bits a value, " + std::string(kKinds) + "; convert it");
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  if (image.channels() == 4) cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY);
  if (grey.channels() != 1)
    refuse(path, "has " + std::to_string(image.channels()) + " channels, expected 1, 3 or 4; convert it to grey");
  return grey;
}

/// 16 bits between the darkest and brightest thousandth to 0 to 255.
void stretch(GreyImage& image) {
  std::vector<float> sorted = image.values;
  const auto thousandth = static_cast<std::ptrdiff_t>(sorted.size() / 1000);
  std::nth_element(sorted.begin(), sorted.begin() + thousandth, sorted.end());
  float low = sorted[static_cast<std::size_t>(thousandth)];
  std::nth_element(sorted.begin(), sorted.end() - 1 - thousandth, sorted.end());
  float high = sorted[sorted.size() - 1 - static_cast<std::size_t>(thousandth)];
  if (low == high) {
    low = *std::min_element(sorted.begin(), sorted.end());
    high = *std::max_element(sorted.begin(), sorted.end());
  }
  const float scale = high > low ? 255 / (high - low) : 0;
  for (float& value : image.values) value = std::clamp((value - low) * scale, 0.0f, 255.0f);
}

void write_png(const fs::path& path, const cv::Mat& picture) {
  std::vector<std::uint8_t> encoded;
  cv::imencode(".png", picture, encoded);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(encoded.data()), static_cast<std::streamsize>(encoded.size()));
  if (!file.flush()) refuse(path, "cannot be written; check the folder and the space left");
}

cv::Mat in_bytes(const GreyImage& image) {
  const cv::Mat grey(image.height, image.width, CV_32F, const_cast<float*>(image.values.data()));
  cv::Mat bytes;
  grey.convertTo(bytes, CV_8U);
  return bytes;
}

cv::Mat drawn_lines(const GreyImage& image, const std::vector<ColourLine>& lines, double scale) {
  cv::Mat picture;
  cv::cvtColor(in_bytes(image), picture, cv::COLOR_GRAY2BGR);
  const cv::Size size(std::max(1, static_cast<int>(std::lround(image.width * scale))),
                      std::max(1, static_cast<int>(std::lround(image.height * scale))));
  cv::resize(picture, picture, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  constexpr int kFraction = 4;  // bits below a pixel
  for (const ColourLine& line : lines) {
    std::vector<cv::Point> points;
    for (const auto& [x, y] : line.points)
      points.emplace_back(static_cast<int>(std::lround((x * scale - 0.5) * (1 << kFraction))),
                          static_cast<int>(std::lround((y * scale - 0.5) * (1 << kFraction))));
    cv::polylines(picture, std::vector<std::vector<cv::Point>>{points}, line.is_closed,
                  cv::Scalar(line.colour[2], line.colour[1], line.colour[0]), 1, cv::LINE_AA, kFraction);
  }
  return picture;
}

ColourImage colour_image(const cv::Mat& picture) {
  ColourImage image(picture.cols, picture.rows, {});
  cv::Mat target(picture.rows, picture.cols, CV_8UC3, image.pixels.data());
  cv::cvtColor(picture, target, cv::COLOR_BGR2RGB);
  return image;
}

}  // namespace

GreyImage read_image(const fs::path& path) {
  const cv::Mat grey = grey_of(path, decoded(path));
  if (grey.cols < kLeastSide || grey.rows < kLeastSide)
    refuse(path, "is " + std::to_string(grey.cols) + " x " + std::to_string(grey.rows) +
                     " pixels, expected 32 a side at least; take a larger image");
  GreyImage image(grey.cols, grey.rows);
  cv::Mat target(grey.rows, grey.cols, CV_32F, image.values.data());
  grey.convertTo(target, CV_32F);
  const auto [darkest, brightest] = std::minmax_element(image.values.begin(), image.values.end());
  if (*darkest == *brightest)
    refuse(path, (*darkest == 0 ? std::string("is black") : "is uniform (every pixel has one grey value)") +
                     ", expected grains on a background; check the exposure");
  if (grey.depth() == CV_16U) stretch(image);
  return image;
}

GreySlice read_slice(const fs::path& path) {
  const cv::Mat image = decoded(path);
  if (image.channels() != 1 || (image.depth() != CV_8U && image.depth() != CV_16U))
    refuse(path, "is no grey image of 8 or 16 bits (" + std::to_string(image.channels()) +
                     " channels); save the grey values, one sample a pixel");
  GreySlice slice{image.cols, image.rows, image.depth() == CV_8U ? 1 : 2, ""};
  for (int y = 0; y < image.rows; ++y)
    slice.samples.append(reinterpret_cast<const char*>(image.ptr(y)),
                         static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(slice.bytes));
  return slice;
}

void write_image(const fs::path& path, const GreyImage& image) { write_png(path, in_bytes(image)); }

ColourImage picture_of(const GreyImage& image, const std::vector<ColourLine>& lines, double scale) {
  return colour_image(drawn_lines(image, lines, scale));
}

void write_picture(const fs::path& path, const GreyImage& image, const std::vector<ColourLine>& lines) {
  const double scale = 2 * std::max(image.width, image.height) <= kLargestPicture ? 2 : 1;
  write_png(path, drawn_lines(image, lines, scale));
}

std::string encoded_png(const ColourImage& image) {
  const cv::Mat picture(image.height, image.width, CV_8UC3, const_cast<Colour*>(image.pixels.data()));
  cv::Mat swapped;
  cv::cvtColor(picture, swapped, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> encoded;
  cv::imencode(".png", swapped, encoded, {cv::IMWRITE_PNG_COMPRESSION, 6});
  return {encoded.begin(), encoded.end()};
}

}  // namespace shape_pipeline
