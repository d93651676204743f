// SPDX-License-Identifier: GPL-3.0-or-later
// CT stacks: readers, bad input, separation of grains with known places.
#include "shape_pipeline/ct_stack.h"

#include <gtest/gtest.h>
#include <tiffio.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "catalog/input_error.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/micrographs/image_file.h"
#include "shape_pipeline/stack_sources.h"
#include "shape_pipeline/volumes/grey_filters.h"
#include "shape_pipeline/volumes/stack_file.h"
#include "tests/support/stack_files.h"
#include "tests/support/temporary_folder.h"

namespace shape_pipeline {
namespace {

using test_support::TemporaryFolder;
using test_support::write_text;

constexpr std::array<double, 3> kVoxel{1e-5, 1e-5, 1e-5};

struct TiffPage {
  int width = 4, height = 3, bits = 8, samples = 1;
  bool is_signed = false;
  std::string bytes;  // of all rows; zeros where empty
  bool is_real = false;
  int tile = 0;  // side of a tile; 0: strips
};

void write_tiles(TIFF* tiff, const TiffPage& page, const std::string& bytes) {
  const int sample = page.bits / 8;
  for (int top = 0; top < page.height; top += page.tile)
    for (int left = 0; left < page.width; left += page.tile) {
      std::string tile(static_cast<std::size_t>(page.tile * page.tile * sample), '\0');
      for (int y = top; y < std::min(page.height, top + page.tile); ++y)
        for (int b = 0; b < sample * std::min(page.tile, page.width - left); ++b)
          tile[static_cast<std::size_t>((y - top) * page.tile * sample + b)] =
              bytes[static_cast<std::size_t>((y * page.width + left) * sample + b)];
      TIFFWriteTile(tiff, tile.data(), static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top), 0, 0);
    }
}

void write_tiff(const std::filesystem::path& path, const std::vector<TiffPage>& pages,
                const std::string& description = "") {
  TIFF* const tiff = TIFFOpen(path.c_str(), "w");
  for (const TiffPage& page : pages) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, page.width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, page.height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, page.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, page.samples);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT,
                 page.is_real     ? SAMPLEFORMAT_IEEEFP
                 : page.is_signed ? SAMPLEFORMAT_INT
                                  : SAMPLEFORMAT_UINT);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, page.samples == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    if (!description.empty()) {
      TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, description.c_str());
      TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 0.1);
      TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 0.1);
    }
    const std::size_t row = static_cast<std::size_t>(page.width * page.samples * page.bits / 8);
    std::string bytes = page.bytes;
    bytes.resize(row * static_cast<std::size_t>(page.height));
    if (page.tile > 0) {
      TIFFSetField(tiff, TIFFTAG_TILEWIDTH, page.tile);
      TIFFSetField(tiff, TIFFTAG_TILELENGTH, page.tile);
      write_tiles(tiff, page, bytes);
    }
    for (int y = 0; page.tile == 0 && y < page.height; ++y)
      TIFFWriteScanline(tiff, bytes.data() + row * static_cast<std::size_t>(y), static_cast<std::uint32_t>(y));
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
}

/// What the reader says against a stack; empty if nothing.
std::string refusal(const std::filesystem::path& path, const StackOptions& options) {
  try {
    digitize_stack(path, options, [](StackGrain&&) {});
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

StackOptions with_voxel() {
  StackOptions options;
  options.voxel_size = kVoxel;
  return options;
}

/// Values of a 16-bit stack of 4 x 3 x 3 voxels: their index times 1000, less 9000 where signed.
std::vector<int> sample_values(bool is_signed) {
  std::vector<int> values;
  for (int i = 0; i < 36; ++i) values.push_back(1000 * i - (is_signed ? 9000 : 0));
  return values;
}

std::string little_endian(const std::vector<int>& values) {
  std::string bytes;
  for (const int value : values) {
    bytes += static_cast<char>(value & 255);
    bytes += static_cast<char>(value >> 8 & 255);
  }
  return bytes;
}

std::vector<int> read_values(const std::filesystem::path& path) {
  const GreyVolume volume = read_stack(path, {kVoxel, 0});
  EXPECT_EQ(volume.grid.size, (std::array<int, 3>{4, 3, 3}));
  std::vector<int> values;
  for (const std::uint16_t value : std::get<std::vector<std::uint16_t>>(volume.values))
    values.push_back(value + static_cast<int>(volume.offset));
  return values;
}

TEST(CtStackReading, SixteenBitsOfEveryFormatSignedAndUnsigned) {
  const TemporaryFolder folder;
  for (const bool is_signed : {false, true}) {
    const std::vector<int> values = sample_values(is_signed);
    const std::string bytes = little_endian(values), type = is_signed ? "int16" : "uint16";
    std::vector<TiffPage> pages(3, {4, 3, 16, 1, is_signed, ""});
    for (std::size_t p = 0; p < 3; ++p) pages[p].bytes = bytes.substr(24 * p, 24);
    write_tiff(folder / "pages.tif", pages);
    EXPECT_EQ(read_values(folder / "pages.tif"), values);

    std::filesystem::create_directories(folder / "slices");
    for (std::size_t p = 0; p < 3; ++p)  // 9, 10, 11: the natural order is not that of the letters
      write_tiff(folder / ("slices/s" + std::to_string(9 + p) + ".tif"), {pages[p]});
    EXPECT_EQ(read_values(folder / "slices"), values);

    write_text(folder / "plain.raw", "head" + bytes);
    write_text(folder / "plain.json", R"({"size": [4, 3, 3], "offset": 4, "type": ")" + type + "\"}");
    EXPECT_EQ(read_values(folder / "plain.raw"), values);

    const std::string header = "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: 4 3 3\nendian: little\n";
    write_text(folder / "raw.nrrd", header + "encoding: raw\n\n" + bytes);
    EXPECT_EQ(read_values(folder / "raw.nrrd"), values);
    const gzFile packed = gzopen((folder / "packed").c_str(), "wb");
    gzwrite(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(packed);
    std::ifstream stream(folder / "packed", std::ios::binary);
    const std::string gzip((std::istreambuf_iterator<char>(stream)), {});
    write_text(folder / "gzip.nrrd", header + "encoding: gzip\n\n" + gzip);
    EXPECT_EQ(read_values(folder / "gzip.nrrd"), values);
    write_text(folder / "cut.nrrd", header + "encoding: gzip\n\n" + gzip.substr(0, gzip.size() / 2));
    EXPECT_NE(refusal(folder / "cut.nrrd", with_voxel()).find("cut off"), std::string::npos);
  }
}

TEST(CtStackReading, TilesAndDetachedHeaders) {
  const TemporaryFolder folder;
  const std::string bytes = little_endian(std::vector<int>(20 * 17 * 3, 0));
  std::string values = bytes;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<char>(i * 7 + i / 256);
  std::vector<TiffPage> pages(3, {20, 17, 16, 1, false, "", false, 16});
  for (std::size_t p = 0; p < 3; ++p) pages[p].bytes = values.substr(p * values.size() / 3, values.size() / 3);
  write_tiff(folder / "tiles.tif", pages);
  write_text(folder / "values.bin", values);
  write_text(folder / "apart.nhdr",
             "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 20 17 3\nendian: little\nencoding: raw\n"
             "data file: values.bin\n");
  const GreyVolume tiles = read_stack(folder / "tiles.tif", {kVoxel, 0});
  const GreyVolume apart = read_stack(folder / "apart.nhdr", {kVoxel, 0});
  EXPECT_EQ(tiles.grid.size, (std::array<int, 3>{20, 17, 3}));
  EXPECT_EQ(std::get<std::vector<std::uint16_t>>(tiles.values), std::get<std::vector<std::uint16_t>>(apart.values));
  const auto& read = std::get<std::vector<std::uint16_t>>(apart.values);
  for (std::size_t i = 0; i < read.size(); ++i)
    ASSERT_EQ(read[i], static_cast<unsigned char>(values[2 * i]) | static_cast<unsigned char>(values[2 * i + 1]) << 8);
  EXPECT_EQ(stack_sources(folder / "apart.nhdr").size(), 2u);
}

TEST(CtStackReading, ImagesOfAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "slices");
  for (int s = 9; s < 12; ++s) {  // 9, 10, 11: the natural order is not that of the letters
    GreyImage image(40, 33);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>((i * 3 + s) % 256);
    write_image(folder / ("slices/s" + std::to_string(s) + ".png"), image);
  }
  const GreyVolume volume = read_stack(folder / "slices", {kVoxel, 0});
  EXPECT_EQ(volume.grid.size, (std::array<int, 3>{40, 33, 3}));
  const auto& values = std::get<std::vector<std::uint8_t>>(volume.values);
  for (std::size_t z = 0; z < 3; ++z)
    for (std::size_t i = 0; i < 40 * 33; ++i) ASSERT_EQ(values[z * 40 * 33 + i], (i * 3 + z + 9) % 256);
}

TEST(CtStackReading, NrrdHeadersThatWouldBendTheVolumeAreRefused) {
  const TemporaryFolder folder;
  const std::string head = "NRRD0004\ntype: uint8\ndimension: 3\nencoding: raw\n", values(27, 'x');
  const auto expect = [&](const std::string& fields, const std::string& reason, const std::string& body) {
    write_text(folder / "a.nrrd", head + fields + "\n\n" + body);
    const std::string found = refusal(folder / "a.nrrd", with_voxel());
    EXPECT_NE(found.find(reason), std::string::npos) << fields << ": " << found;
  };
  const std::string sizes = "sizes: 3 3 3\n", units = "\nspace units: \"mm\" \"mm\" \"mm\"";
  expect(sizes + "space directions: (1,0,0) (0.5,1,0) (0,0,1)" + units, "square to one another", values);
  expect(sizes + "space directions: (1,0,0) (0,1,0) (0,0,-1)" + units, "right-handed", values);
  expect(sizes + "byte skip: 16", "expected 0, found '16'", values);
  expect(sizes + "data file: a.nrrd", "names the header itself", values);
  expect("sizes: 3 3 3.9", "three axes", values);
  expect(sizes + "content: x", "more values than its header says", values + "x");
}

// Half a step of 65,535 is what rounding may take; one voxel far beyond all others is clipped.
TEST(CtStackReading, RealNumbersBecomeSteps) {
  const TemporaryFolder folder;
  std::vector<float> values;
  for (int i = 0; i < 30 * 30 * 30; ++i) values.push_back(static_cast<float>(-0.02 + 0.07 * (i % 1000) / 999.0));
  values[12345] = 1e6f;
  std::string little(reinterpret_cast<const char*>(values.data()), 4 * values.size()), big = little;
  for (std::size_t i = 0; i < big.size(); i += 4) std::reverse(big.begin() + i, big.begin() + i + 4);
  write_text(folder / "a.raw", big);
  write_text(folder / "a.json", R"({"size": [30, 30, 30], "type": "float32", "endian": "big"})");
  write_text(folder / "a.nrrd",
             "NRRD0004\ntype: float\ndimension: 3\nsizes: 30 30 30\nendian: little\nencoding: raw\n\n" + little);
  std::vector<TiffPage> pages(30, {30, 30, 32, 1, false, "", true});
  for (std::size_t p = 0; p < 30; ++p) pages[p].bytes = little.substr(3600 * p, 3600);
  write_tiff(folder / "a.tif", pages);
  for (const char* name : {"a.raw", "a.nrrd", "a.tif"}) {
    const GreyVolume volume = read_stack(folder / name, {kVoxel, 0});
    EXPECT_LT(volume.step, 1.6 * 0.07 / 65535) << name;
    const auto& steps = std::get<std::vector<std::uint16_t>>(volume.values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (i != 12345) {
        ASSERT_NEAR(steps[i] * volume.step + volume.offset, values[i], 0.51 * volume.step) << name;
      }
  }
}

TEST(CtStackReading, VoxelSizesOfFiles) {
  const TemporaryFolder folder;
  write_tiff(folder / "imagej.tif", std::vector<TiffPage>(3), "ImageJ=1.53\nimages=3\nunit=micron\nspacing=20.0\n");
  write_text(folder / "a.nrrd",
             "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nspace directions: (0.01,0,0) (0,0.01,0) "
             "(0,0,0.02)\nspace units: \"mm\" \"mm\" \"mm\"\nencoding: raw\n\n" +
                 std::string(27, 'x'));
  for (const char* const file : {"imagej.tif", "a.nrrd"}) {
    const GreyVolume volume = read_stack(folder / file, {});
    EXPECT_NEAR(volume.grid.spacing[0], 1e-5, 1e-11) << file;  // single precision in the TIFF
    EXPECT_NEAR(volume.grid.spacing[2], 2e-5, 1e-11) << file;
    const std::string conflict = refusal(folder / file, with_voxel());
    EXPECT_NE(conflict.find("states a voxel of 10 x 10 x 20 um, --voxel one of 10 x 10 x 10 um"), std::string::npos)
        << conflict;
  }
}

TEST(CtStackReading, BadInputIsRefusedByName) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& file, const std::string& reason, StackOptions options = with_voxel()) {
    const std::string found = refusal(folder / file, options);
    EXPECT_EQ(found.find((folder / file.substr(0, file.find('.'))).string()), 0u) << found;
    EXPECT_NE(found.find(reason), std::string::npos) << file << ": " << found;
  };
  write_tiff(folder / "sizes.tif", {TiffPage{}, TiffPage{}, TiffPage{5, 3, 8, 1, false, ""}});
  expect("sizes.tif", "slice 3: has 5 x 3 pixels of 8 bits, the first slice 4 x 3");
  write_tiff(folder / "black.tif", std::vector<TiffPage>(3));
  expect("black.tif", "all voxels are equally grey");
  expect("black.tif", "states no voxel size", {});
  write_tiff(folder / "colour.tif", std::vector<TiffPage>(3, {4, 3, 8, 3, false, ""}));
  expect("colour.tif", "colour");
  write_tiff(folder / "wide.tif", std::vector<TiffPage>(3, {4, 3, 32, 1, false, ""}));
  expect("wide.tif", "32 bits");
  std::vector<TiffPage> reals(3, {4, 3, 32, 1, false, "", true});
  reals[1].bytes = std::string("\x00\x00\xc0\x7f", 4);
  write_tiff(folder / "real.tif", reals);
  expect("real.tif", "1 voxels are no numbers");
  std::filesystem::create_directories(folder / "mixed");
  write_text(folder / "mixed/1.png", "x");
  write_text(folder / "mixed/2.bmp", "x");
  expect("mixed", "images of two kinds");
  write_text(folder / "away.nhdr",
             "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nencoding: raw\ndata file: none.raw\n");
  expect("away.nhdr", "there is no file");
  write_tiff(folder / "single.tif", {TiffPage{}});
  expect("single.tif", "one page");
  write_text(folder / "empty.tif", "");
  expect("empty.tif", "the file is empty");
  write_text(folder / "empty.nrrd", "");
  expect("empty.nrrd", "the file is empty");
  expect("missing.tif", "no such file");

  write_tiff(folder / "whole.tif", std::vector<TiffPage>(5, {40, 30, 8, 1, false, ""}));
  const auto bytes = std::filesystem::file_size(folder / "whole.tif");
  for (const auto kept : {bytes / 8, bytes / 2, bytes - 100}) {
    std::filesystem::copy_file(folder / "whole.tif", folder / "cut.tif",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder / "cut.tif", kept);
    const std::string found = refusal(folder / "cut.tif", with_voxel());
    EXPECT_NE(found.find("cut"), std::string::npos) << kept;
    EXPECT_EQ(found.find("equally grey"), std::string::npos) << "read as if it were whole: " << found;
  }

  write_text(folder / "bad.raw", std::string(26, 'x'));
  expect("bad.raw", "a RAW needs this file beside it");
  write_text(folder / "bad.json", R"({"size": [3, 3, 3], "type": "uint8"})");
  expect("bad.raw", "has 26 bytes, its sidecar says 27");
  write_text(folder / "bad.json", R"({"size": [3, 3, 3], "type": "uint8", "voxelsize": 3})");
  expect("bad.raw", "did you mean 'voxel_size'?");
  write_text(folder / "bad.json", R"({"size": [3, 3, 3], "type": "uint8", "voxel_size": NaN})");
  expect("bad.raw", "is no JSON");
  write_text(folder / "nan.nrrd",
             "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nspacings: 1 nan 1\nunits: \"mm\" "
             "\"mm\" \"mm\"\nencoding: raw\n\n" +
                 std::string(27, 'x'));
  expect("nan.nrrd", "three numbers above 0", {});
}

TEST(CtStackReading, StatesTheMemoryItNeedsBeforeItTakesIt) {
  const TemporaryFolder folder;
  write_text(folder / "large.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1000 1000 1000\nencoding: raw\n\nx");
  StackOptions options = with_voxel();
  options.memory_limit = 5e9;
  EXPECT_NE(
      refusal(folder / "large.nrrd", options).find("needs 6.0 GB of memory (6 bytes a voxel), 5.0 GB may be used"),
      std::string::npos);
}

/// Grey values of balls with exact edges blurred over a voxel: 40 outside, 200 inside.
GreyVolume balls(const std::array<int, 3>& size, const std::vector<std::array<double, 4>>& places) {
  GreyVolume volume{{size, kVoxel}, std::vector<std::uint8_t>(), 0};
  auto& values = std::get<std::vector<std::uint8_t>>(volume.values);
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x) {
        double inside = -1e9;
        for (const auto& [u, v, w, radius] : places)
          inside = std::max(inside, radius - std::hypot(x - u, y - v, z - w));
        values.push_back(static_cast<std::uint8_t>(std::lround(40 + 160 * std::clamp(inside + 0.5, 0.0, 1.0))));
      }
  return volume;
}

TEST(CtStack, PartsTouchingBallsDropsThoseAtTheBorderAndRefusesSmallOnes) {
  const TemporaryFolder folder;
  // Two that overlap by a voxel, one cut by the border, one of 9 voxels a diameter, a speck.
  test_support::write_raw_stack(
      folder / "balls.raw",
      balls({80, 40, 40},
            {{{16, 20, 20, 12}, {38, 20, 20, 11}, {78, 20, 20, 10}, {60, 8, 8, 4.5}, {60, 32, 32, 1.2}}}));
  std::vector<StackGrain> grains;
  const auto keep = [&](StackGrain&& grain) { grains.push_back(std::move(grain)); };
  const StackSummary summary = digitize_stack(folder / "balls.raw", {}, keep);
  EXPECT_EQ(summary.grains, 3u);
  EXPECT_EQ(summary.refused, 1u);
  EXPECT_EQ(summary.at_border, 1u);
  EXPECT_EQ(summary.specks, 1u);
  ASSERT_EQ(grains.size(), 3u);
  EXPECT_NE(grains[2].refusal.find("voxels a diameter, at least 10 are asked for"), std::string::npos);
  for (std::size_t g = 0; g < 2; ++g) {
    const double radius = g == 0 ? 12 : 11, volume = 4.0 / 3 * std::numbers::pi * std::pow(radius * 1e-5, 3);
    // A shift of the surface by 0.1 voxels changes the volume by 0.3 / radius.
    EXPECT_NEAR(grains[g].shape.mass_properties.volume / volume, 1, 0.3 / radius);
    EXPECT_NEAR(grains[g].centre[0], (g == 0 ? 16 : 38) * 1e-5, 1e-6);
    EXPECT_EQ(mesh_topology(grains[g].shape.mesh).euler_number, 2);
    EXPECT_FALSE(grains[g].shape.descriptors.empty());
    for (const catalog::Check& check : grains[g].shape.checks) EXPECT_TRUE(check.passed) << check.name << check.detail;
  }
  std::vector<StackGrain> again;
  digitize_stack(folder / "balls.raw", {}, [&](StackGrain&& grain) { again.push_back(std::move(grain)); });
  EXPECT_EQ(again[0].shape.mesh.vertices, grains[0].shape.mesh.vertices);
}

TEST(CtStack, CavitiesAreFilledOrKept) {
  const TemporaryFolder folder;
  GreyVolume hollow = balls({40, 40, 40}, {{{20, 20, 20, 14}}});
  const GreyVolume core = balls({40, 40, 40}, {{{20, 20, 20, 6}}});
  auto& values = std::get<std::vector<std::uint8_t>>(hollow.values);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<std::uint8_t>(values[i] - std::get<std::vector<std::uint8_t>>(core.values)[i] + 40);
  test_support::write_raw_stack(folder / "hollow.raw", hollow);
  const double ball = 4.0 / 3 * std::numbers::pi * 1e-15;
  for (const bool keeps : {false, true}) {
    StackOptions options;
    options.keeps_cavities = keeps;
    digitize_stack(folder / "hollow.raw", options, [&](StackGrain&& grain) {
      EXPECT_NEAR(grain.shape.mass_properties.volume / ball / (14 * 14 * 14 - (keeps ? 6 * 6 * 6 : 0)), 1, 0.3 / 14);
      EXPECT_EQ(mesh_topology(grain.shape.mesh).components, keeps ? 2u : 1u);
    });
  }
}

TEST(GreyFilters, MedianIsThatOfTheNeighbourhood) {
  GreyVolume volume{{{70, 5, 4}, kVoxel}, std::vector<std::uint8_t>(), 0};
  auto& values = std::get<std::vector<std::uint8_t>>(volume.values);
  for (std::uint32_t i = 0; i < volume.grid.count(); ++i)
    values.push_back(static_cast<std::uint8_t>(i * 2654435761u >> 24));
  const std::vector<std::uint8_t> before = values;
  median_filter(volume);
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 70; ++x) {
        std::vector<std::uint8_t> near;
        for (int w = z - 1; w <= z + 1; ++w)
          for (int v = y - 1; v <= y + 1; ++v)
            for (int u = x - 1; u <= x + 1; ++u)
              near.push_back(before[volume.grid.index(std::clamp(u, 0, 69), std::clamp(v, 0, 4), std::clamp(w, 0, 3))]);
        std::sort(near.begin(), near.end());
        ASSERT_EQ(values[volume.grid.index(x, y, z)], near[13]) << x << ' ' << y << ' ' << z;
      }
}

}  // namespace
}  // namespace shape_pipeline
