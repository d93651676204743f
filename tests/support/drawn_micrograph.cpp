// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/drawn_micrograph.h"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace test_support {
namespace {

constexpr int kSamples = 8;  // a side of a pixel

double coverage(const DrawnGrain& grain, int x, int y) {
  if (std::hypot(x + 0.5 - grain.x, y + 0.5 - grain.y) > grain.half_length + 1) return 0;
  int inside = 0;
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const double dx = x + (k % kSamples + 0.5) / kSamples - grain.x;
    const double dy = y + (k / kSamples + 0.5) / kSamples - grain.y;
    const double along = dx * std::cos(grain.angle) + dy * std::sin(grain.angle);
    const double across = dy * std::cos(grain.angle) - dx * std::sin(grain.angle);
    inside += std::hypot(along / grain.half_length, across / grain.half_width) < 1;
  }
  return inside / static_cast<double>(kSamples * kSamples);
}

cv::Mat drawn(const DrawnMicrograph& drawing) {
  cv::Mat image(drawing.height, drawing.width, CV_32F, cv::Scalar(drawing.background));
  for (const DrawnGrain& grain : drawing.grains)
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        if (const double share = coverage(grain, x, y); share > 0)
          image.at<float>(y, x) = static_cast<float>((1 - share) * image.at<float>(y, x) + share * grain.grey);
  if (drawing.blur > 0) cv::GaussianBlur(image, image, {}, drawing.blur);
  cv::RNG random(drawing.seed);
  cv::Mat noise(image.size(), CV_32F);
  random.fill(noise, cv::RNG::NORMAL, 0, drawing.noise);
  image += noise;
  if (drawing.strip == 0) return image;
  cv::Mat strip(drawing.strip, drawing.width, CV_32F, cv::Scalar(0)), whole;
  cv::putText(strip, "20 kV", {4, drawing.strip - 6}, cv::FONT_HERSHEY_SIMPLEX, 0.4, cv::Scalar(255));
  const int middle = drawing.strip / 2;
  if (drawing.bar[1] > drawing.bar[0])
    strip(cv::Range(middle, middle + 3), cv::Range(drawing.bar[0], drawing.bar[1])).setTo(255);
  cv::vconcat(image, strip, whole);
  return whole;
}

}  // namespace

void write_drawn(const std::filesystem::path& path, const DrawnMicrograph& drawing, PixelKind kind) {
  cv::Mat pixels;
  if (kind == PixelKind::grey_16)
    drawn(drawing).convertTo(pixels, CV_16U, 100);
  else
    drawn(drawing).convertTo(pixels, CV_8U);
  if (kind == PixelKind::colour_8) cv::cvtColor(pixels, pixels, cv::COLOR_GRAY2BGR);
  cv::imwrite(path.string(), pixels);
}

void write_uniform(const std::filesystem::path& path, int width, int height, int grey) {
  cv::imwrite(path.string(), cv::Mat(height, width, CV_8U, cv::Scalar(grey)));
}

shape_pipeline::Outline outline_of(const DrawnGrain& grain) {
  constexpr int kCorners = 256;
  shape_pipeline::Outline outline;
  for (int k = 0; k < kCorners; ++k) {
    const double turn = 2 * std::numbers::pi * k / kCorners;
    const double along = grain.half_length * std::cos(turn), across = grain.half_width * std::sin(turn);
    outline.push_back({grain.x + along * std::cos(grain.angle) - across * std::sin(grain.angle),
                       grain.y + along * std::sin(grain.angle) + across * std::cos(grain.angle)});
  }
  return outline;
}

}  // namespace test_support
