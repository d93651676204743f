// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/reader_seeds.h"

#include <tiffio.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace fuzz {
namespace {

namespace fs = std::filesystem;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Rows of points on a ball.
std::string ball_rows(int count) {
  std::string rows;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z), angle = 2.4 * i;
    rows += number(r * std::cos(angle)) + " " + number(r * std::sin(angle)) + " " + number(z) + "\n";
  }
  return rows;
}

template <class T>
void append(std::string& bytes, const T& value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string binary_stl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{4});
  for (const auto& face : kFaces) {
    bytes.append(12, '\0');
    for (const int corner : face)
      for (const float coordinate : kCorners[corner]) append(bytes, coordinate);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string text_stl() {
  std::string text = "solid t\n";
  for (const auto& face : kFaces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face)
      text += "vertex " + number(kCorners[corner][0]) + " " + number(kCorners[corner][1]) + " " +
              number(kCorners[corner][2]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

std::string binary_ply() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& corner : kCorners)
    for (const float coordinate : corner) append(bytes, coordinate);
  for (const auto& face : kFaces) {
    append(bytes, std::uint8_t{3});
    for (const int corner : face) append(bytes, corner);
  }
  return bytes;
}

std::string vertex_rows(const std::string& before) {
  std::string rows;
  for (const auto& corner : kCorners)
    rows += before + number(corner[0]) + " " + number(corner[1]) + " " + number(corner[2]) + "\n";
  return rows;
}

std::string face_rows(const std::string& before, int first) {
  std::string rows;
  for (const auto& face : kFaces)
    rows += before + std::to_string(face[0] + first) + " " + std::to_string(face[1] + first) + " " +
            std::to_string(face[2] + first) + "\n";
  return rows;
}

/// Two pages of 4 x 3, 8 bits.
std::string tiff_pages() {
  const fs::path path = fs::temp_directory_path() / ("talus-fuzz-seed-" + std::to_string(getpid()) + ".tif");
  TIFF* const tiff = TIFFOpen(path.c_str(), "w");
  for (int page = 0; page < 2; ++page) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 4);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 3);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    char row[4] = {1, 2, 3, 4};
    for (std::uint32_t y = 0; y < 3; ++y) TIFFWriteScanline(tiff, row, y);
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
  std::ifstream stream(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  fs::remove(path);
  return bytes;
}

/// 36 x 34 pixels: a bright disc on a ramp.
std::string image(const std::string& ending, int type) {
  cv::Mat pixels(34, 36, type);
  for (int y = 0; y < pixels.rows; ++y)
    for (int x = 0; x < pixels.cols; ++x) {
      const int grey = std::hypot(x - 18, y - 17) < 9 ? 220 : x + y;
      for (int c = 0; c < pixels.channels(); ++c)
        if (pixels.depth() == CV_8U)
          pixels.ptr<std::uint8_t>(y, x)[c] = static_cast<std::uint8_t>(grey);
        else
          pixels.ptr<std::uint16_t>(y, x)[c] = static_cast<std::uint16_t>(200 * grey);
    }
  std::vector<std::uint8_t> encoded;
  cv::imencode(ending, pixels, encoded);
  return {encoded.begin(), encoded.end()};
}

}  // namespace

std::vector<std::string> reader_seeds() {
  constexpr int kPoints = 60;
  const std::string count = std::to_string(kPoints), voxels(24, 'v');
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  return {".xyz\n" + ball_rows(kPoints),
          ".ply\nply\nformat ascii 1.0\nelement vertex " + count + "\n" + xyz + "end_header\n" + ball_rows(kPoints),
          ".ply\n" + binary_ply(),
          ".pcd\n# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
              "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA ascii\n" + ball_rows(kPoints),
          ".stl\n" + binary_stl(),
          ".stl\n" + text_stl(),
          ".obj\n" + vertex_rows("v ") + face_rows("f ", 1),
          ".off\nOFF\n4 4 6\n" + vertex_rows("") + face_rows("3 ", 0),
          ".tab\n" + vertex_rows("v ") + face_rows("f ", 1),
          ".tif\n" + tiff_pages(),
          ".nrrd\nNRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n\n" + voxels,
          ".raw\n{\"size\": [4, 3, 2], \"type\": \"uint8\", \"voxel_size\": 12, \"unit\": \"um\"}" +
              std::string(1, '\0') + voxels,
          ".png\n" + image(".png", CV_8UC1),
          ".png\n" + image(".png", CV_16UC3),
          ".jpg\n" + image(".jpg", CV_8UC1),
          ".bmp\n" + image(".bmp", CV_8UC3),
          ".turntable\n{\"unit\": \"mm\", \"pixel_size\": 0.02, \"elevation\": 10, \"axis_column\": 18.5, \"turn\": "
          "\"clockwise\", \"angles\": [0, 30, 60, 90, 120, 150, 180, 210, 240, 270, 300, 330]}",
          ".turntable\n{\"unit\": \"um\", \"focal_length\": 2400, \"principal_point\": [18, 17], \"distance\": 250}"};
}

}  // namespace fuzz
