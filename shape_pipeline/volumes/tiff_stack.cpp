// SPDX-License-Identifier: GPL-3.0-or-later
#include <tiffio.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "shape_pipeline/reading/scan_bytes.h"
#include "shape_pipeline/volumes/stack_file.h"

namespace shape_pipeline {
namespace {

namespace fs = std::filesystem;

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

struct Page {
  std::uint32_t width = 0, height = 0;
  SampleType type;
};

TiffFile open_tiff(const fs::path& path) {
  if (!fs::exists(path)) refuse_file(path, "", "there is no such file", "check the path of the stack");
  if (fs::file_size(path) == 0) refuse_file(path, "", "the file is empty", "export the stack again");
  TIFFSetErrorHandler(nullptr);  // what it says is told by what cannot be read, with the file's name
  TIFFSetWarningHandler(nullptr);
  TiffFile tiff(TIFFOpen(path.c_str(), "r"));
  if (!tiff) refuse_file(path, "", "is no TIFF, or is cut off", "export the stack again");
  return tiff;
}

Page current_page(const fs::path& path, TIFF* tiff) {
  Page page;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT, photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  if (samples != 1 || photometric == PHOTOMETRIC_PALETTE || photometric == PHOTOMETRIC_RGB)
    refuse_file(path, "", "is a colour image", "save the grey values, one sample a pixel and no palette");
  if (photometric == PHOTOMETRIC_MINISWHITE)
    refuse_file(path, "", "counts 0 as white", "invert it, so that dense matter is bright");
  const bool is_real = format == SAMPLEFORMAT_IEEEFP;
  const bool is_whole = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT || format == SAMPLEFORMAT_VOID;
  if (!(is_whole && (bits == 8 || bits == 16)) && !(is_real && bits == 32))
    refuse_file(path, "",
                "has grey values of " + std::to_string(bits) + " bits" +
                    (is_real    ? ", real numbers"
                     : is_whole ? ""
                                : ", complex"),
                "save them as whole numbers of 8 or 16 bits, or as real ones of 32");
  // libtiff hands over samples in the order of this machine.
  page.type = {bits / 8, format == SAMPLEFORMAT_INT || is_real, std::endian::native == std::endian::big, is_real};
  return page;
}

bool is_same(const Page& a, const Page& b) {
  return a.width == b.width && a.height == b.height && a.type.bytes == b.type.bytes &&
         a.type.is_signed == b.type.is_signed && a.type.is_real == b.type.is_real;
}

void require_same(const fs::path& path, const std::string& place, const Page& page, const Page& first) {
  const auto text = [](const Page& p) {
    return std::to_string(p.width) + " x " + std::to_string(p.height) + " pixels of " +
           std::to_string(8 * p.type.bytes) + (p.type.is_signed ? " signed" : "") + " bits";
  };
  if (!is_same(page, first))
    refuse_file(path, place, "has " + text(page) + ", the first slice " + text(first),
                "give slices of one size and type");
}

[[noreturn]] void refuse_row(const fs::path& path, int slice, std::uint32_t row) {
  refuse_file(path, "slice " + std::to_string(slice + 1),
              "row " + std::to_string(row + 1) + " cannot be read: the file is cut off or damaged",
              "export or copy the stack again");
}

void read_tiles(const fs::path& path, TIFF* tiff, int slice, SampleSink& sink) {
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  const auto columns = static_cast<std::uint32_t>(sink.grid().size[0]);
  const auto rows = static_cast<std::uint32_t>(sink.grid().size[1]);
  const auto bytes = static_cast<std::size_t>(sink.type().bytes);
  constexpr double kLargestTile = 1 << 28;  // [bytes]; tiles are some hundred pixels wide
  const double tile_bytes = static_cast<double>(width) * height * static_cast<double>(bytes);
  if (tile_bytes > kLargestTile)
    refuse_file(path, "", "is stored in tiles of " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                "save it in strips (tiffcp -s)");
  std::string tile(static_cast<std::size_t>(TIFFTileSize(tiff)), '\0');
  if (width == 0 || height == 0 || static_cast<double>(tile.size()) < tile_bytes) refuse_row(path, slice, 0);
  for (std::uint32_t top = 0; top < rows; top += height)
    for (std::uint32_t left = 0; left < columns; left += width) {
      if (TIFFReadTile(tiff, tile.data(), left, top, 0, 0) < 0) refuse_row(path, slice, top);
      const std::size_t run = std::min(width, columns - left) * bytes;
      for (std::uint32_t y = top; y < std::min(rows, top + height); ++y)
        sink.store(sink.grid().index(static_cast<int>(left), static_cast<int>(y), slice),
                   std::string_view(tile).substr((y - top) * width * bytes, run));
    }
}

void read_page(const fs::path& path, TIFF* tiff, int slice, SampleSink& sink) {
  if (TIFFIsTiled(tiff)) return read_tiles(path, tiff, slice, sink);
  std::string row(static_cast<std::size_t>(TIFFScanlineSize(tiff)), '\0');
  const std::size_t bytes = static_cast<std::size_t>(sink.grid().size[0]) * static_cast<std::size_t>(sink.type().bytes);
  for (int y = 0; y < sink.grid().size[1]; ++y) {
    if (row.size() < bytes || TIFFReadScanline(tiff, row.data(), static_cast<std::uint32_t>(y)) < 0)
      refuse_row(path, slice, static_cast<std::uint32_t>(y));
    sink.store(sink.grid().index(0, y, slice), std::string_view(row).substr(0, bytes));
  }
}

std::string description(TIFF* tiff) {
  char* text = nullptr;
  return TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text ? text : "";
}

/// The number or word behind "key=" in the lines that ImageJ writes; empty without it.
std::string imagej_value(const std::string& text, const std::string& key) {
  if (!text.starts_with("ImageJ=")) return "";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(key + "=")) return line.substr(key.size() + 1);
  return "";
}

/// ImageJ's calibration: pixels a unit in the resolution, unit and slice spacing in the description. The dots per inch
/// of other programs say nothing about a tomogram.
std::array<double, 3> imagej_spacing(TIFF* tiff) {
  const std::string text = description(tiff);
  const double unit = metres_of_unit(imagej_value(text, "unit"));
  float x = 0, y = 0;
  double slice = 0;
  if (unit == 0 || TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x) != 1 ||
      TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y) != 1 || !(x > 0) || !(y > 0) ||
      !parse_number(imagej_value(text, "spacing"), slice) || !(slice > 0))
    return {};
  return {unit / static_cast<double>(x), unit / static_cast<double>(y), unit * slice};
}

}  // namespace

GreyVolume read_tiff_stack(const fs::path& path, double memory_limit) {
  const TiffFile tiff = open_tiff(path);
  const Page first = current_page(path, tiff.get());
  const int pages = static_cast<int>(TIFFNumberOfDirectories(tiff.get()));
  double images = 0;
  if (pages == 1 && parse_number(imagej_value(description(tiff.get()), "images"), images) && images > 1)
    refuse_file(path, "", "is ImageJ's form of a stack above 4 GB, which has one page", "export it as NRRD or RAW");
  if (pages == 1)
    refuse_file(path, "", "has one page: an image, no stack",
                "give a multi-page TIFF, or a folder of slices with --stack");
  SampleSink sink(path, {static_cast<int>(first.width), static_cast<int>(first.height), pages}, first.type,
                  memory_limit);
  sink.set_spacing(imagej_spacing(tiff.get()));
  for (int slice = 0; slice < pages; ++slice) {
    if (slice > 0 && !TIFFReadDirectory(tiff.get()))
      refuse_file(path, "slice " + std::to_string(slice + 1), "cannot be read", "export the stack again");
    require_same(path, "slice " + std::to_string(slice + 1), current_page(path, tiff.get()), first);
    read_page(path, tiff.get(), slice, sink);
  }
  if (!TIFFLastDirectory(tiff.get()))
    refuse_file(path, "slice " + std::to_string(pages + 1), "the file is cut off or damaged there",
                "export or copy the stack again");
  return sink.finished();
}

GreyVolume read_tiff_slices(const fs::path& path, const std::vector<fs::path>& slices, double memory_limit) {
  std::optional<SampleSink> sink;
  Page first;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    const TiffFile tiff = open_tiff(slices[s]);
    const Page page = current_page(slices[s], tiff.get());
    if (!TIFFLastDirectory(tiff.get()))
      refuse_file(slices[s], "", "has several pages in a folder of slices",
                  "give one slice a file, or this file alone");
    if (s == 0) {
      first = page;
      sink.emplace(path,
                   std::array<int, 3>{static_cast<int>(page.width), static_cast<int>(page.height),
                                      static_cast<int>(slices.size())},
                   page.type, memory_limit);
    }
    require_same(slices[s], "", page, first);
    read_page(slices[s], tiff.get(), static_cast<int>(s), *sink);
  }
  return sink->finished();
}

}  // namespace shape_pipeline
