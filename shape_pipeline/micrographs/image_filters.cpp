// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/micrographs/image_filters.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace shape_pipeline {
namespace {

// OpenCV's matrices over our pixels; those it only reads lose their const here alone.
cv::Mat view(const GreyImage& image) {
  return {image.height, image.width, CV_32F, const_cast<float*>(image.values.data())};
}
cv::Mat view(const Mask& mask) {
  return {mask.height, mask.width, CV_8U, const_cast<std::uint8_t*>(mask.values.data())};
}

}  // namespace

GreyImage blurred(const GreyImage& image, double sigma) {
  GreyImage result(image.width, image.height);
  cv::Mat target = view(result);
  cv::GaussianBlur(view(image), target, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return result;
}

GreyImage gradient_length(const GreyImage& image) {
  cv::Mat across, down;
  constexpr double kPerPixel = 1.0 / 8;
  cv::Sobel(view(image), across, CV_32F, 1, 0, 3, kPerPixel);
  cv::Sobel(view(image), down, CV_32F, 0, 1, 3, kPerPixel);
  GreyImage result(image.width, image.height);
  cv::Mat target = view(result);
  cv::magnitude(across, down, target);
  return result;
}

DistanceImage distance_to_outside(const Mask& mask) {
  DistanceImage result(mask.width, mask.height);
  cv::Mat target = view(result);
  cv::distanceTransform(view(mask), target, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  return result;
}

Mask opened(const Mask& mask) {
  Mask result(mask.width, mask.height);
  cv::Mat target = view(result);
  cv::morphologyEx(view(mask), target, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  return result;
}

void fill_pits(Mask& mask, int largest) {
  const cv::Mat dark = view(mask) == 0;
  cv::Mat labels, figures, centres;
  cv::connectedComponentsWithStats(dark, labels, figures, centres, 4, CV_32S);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (const int label = labels.at<int>(y, x); label && figures.at<int>(label, cv::CC_STAT_AREA) <= largest)
        mask(x, y) = 255;
}

Mask largest_region(const Mask& mask) {
  cv::Mat labels, figures, centres;
  const int count = cv::connectedComponentsWithStats(view(mask), labels, figures, centres, 4, CV_32S);
  int largest = 0, area = 0;
  for (int label = 1; label < count; ++label)
    if (figures.at<int>(label, cv::CC_STAT_AREA) > area) {
      largest = label;
      area = figures.at<int>(label, cv::CC_STAT_AREA);
    }
  Mask result(mask.width, mask.height);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) result(x, y) = largest != 0 && labels.at<int>(y, x) == largest ? 255 : 0;
  return result;
}

}  // namespace shape_pipeline
