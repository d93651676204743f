// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/page_pictures.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

namespace test_support {
namespace {

std::vector<std::uint8_t> decoded_base64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    bits = bits << 6U | static_cast<unsigned>(kDigits.find(letter));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
    bits &= (1U << count) - 1;
  }
  return bytes;
}

std::string_view between(std::string_view text, std::string_view first, std::string_view last, std::size_t& at) {
  at = text.find(first, at);
  if (at == text.npos) return {};
  at += first.size();
  return text.substr(at, text.find(last, at) - at);
}

}  // namespace

std::size_t PagePixels::count(const std::function<bool(const std::array<int, 3>&)>& is_meant) const {
  return static_cast<std::size_t>(std::count_if(pixels.begin(), pixels.end(), is_meant));
}

std::vector<PagePixels> pictures_in(const std::string& page) {
  std::vector<PagePixels> pictures;
  for (std::size_t at = 0;;) {
    const std::string_view caption = between(page, "<img alt=\"", "\"", at);
    if (at == page.npos) return pictures;
    const cv::Mat image =
        cv::imdecode(decoded_base64(between(page, "data:image/png;base64,", "\"", at)), cv::IMREAD_COLOR);
    PagePixels picture{std::string(caption), image.cols, image.rows, {}};
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) {
        const auto& pixel = image.at<cv::Vec3b>(y, x);
        picture.pixels.push_back({pixel[2], pixel[1], pixel[0]});
      }
    pictures.push_back(std::move(picture));
  }
}

}  // namespace test_support
