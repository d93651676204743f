// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/io/hdf5_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "catalog/input_error.h"
#include "tests/support/temporary_folder.h"

namespace {

using dem_gpu::io::ArrayShape;
using dem_gpu::io::Hdf5Reader;
using dem_gpu::io::Hdf5Writer;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using test_support::write_bytes;

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const catalog::InputError& error) {
    return error.what();
  }
  return "";
}

void write_sample(const std::filesystem::path& path) {
  Hdf5Writer file(path, "sample", 2);
  std::vector<double> wave(30000);
  for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = std::sin(0.1 * static_cast<double>(i));
  file.write("deep/er/wave", wave, 3);
  file.write("bytes", std::vector<std::uint8_t>{0, 255, 7});
  file.write("longs", std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::min(), 0}, 2);
  file.write("none", std::vector<std::int32_t>{}, 2);
  file.write("floats", std::vector<float>{1.5F, -0.0F});
  file.write_strings("names", {"ore", "", "steel ball"});
  file.write_attribute("note", std::string(""));
  file.write_attribute("tiny", 5e-324);
  file.write_attribute("count", std::int64_t{-3});
  file.commit();
}

TEST(Hdf5File, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const Hdf5Reader file(folder / "a.h5", "sample", 2);
  EXPECT_EQ(file.version(), 2);
  EXPECT_EQ(file.shape("deep/er/wave"), (ArrayShape{10000, 3}));
  const std::vector<double> wave = file.read<double>("deep/er/wave", 3);
  for (std::size_t i = 0; i < wave.size(); ++i) ASSERT_EQ(wave[i], std::sin(0.1 * static_cast<double>(i)));
  EXPECT_EQ(file.read<std::uint8_t>("bytes"), (std::vector<std::uint8_t>{0, 255, 7}));
  EXPECT_EQ(file.read<std::int64_t>("longs", 2).front(), std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(file.read<std::int32_t>("none", 2).empty());
  EXPECT_TRUE(std::signbit(file.read<float>("floats")[1]));
  EXPECT_EQ(file.read_strings("names"), (std::vector<std::string>{"ore", "", "steel ball"}));
  EXPECT_EQ(file.string_attribute("note"), "");
  EXPECT_EQ(file.double_attribute("tiny"), 5e-324);
  EXPECT_EQ(file.integer_attribute("count"), -3);
  EXPECT_TRUE(file.has("deep/er"));
  EXPECT_FALSE(file.has("deep/est/wave"));
}

TEST(Hdf5File, NotANumberKeepsItsBits) {
  const TemporaryFolder folder;
  const double odd = std::bit_cast<double>(std::uint64_t{0x7ff8000000abcdef});
  Hdf5Writer file(folder / "a.h5", "sample", 1);
  file.write("x", std::vector<double>{odd});
  file.commit();
  const double back = Hdf5Reader(folder / "a.h5", "sample", 1).read<double>("x")[0];
  EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(odd));
}

TEST(Hdf5File, EqualContentsGiveEqualBytes) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  std::vector<std::vector<double>> heap_noise(100, std::vector<double>(1000, 3.25));
  write_sample(folder / "another name.h5");
  EXPECT_EQ(read_bytes(folder / "a.h5"), read_bytes(folder / "another name.h5"));
}

TEST(Hdf5File, EarlierFileStaysUntilCommit) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const std::string before = read_bytes(folder / "a.h5");
  {
    Hdf5Writer file(folder / "a.h5", "sample", 2);
    file.write("bytes", std::vector<std::uint8_t>{1});
  }
  EXPECT_EQ(read_bytes(folder / "a.h5"), before);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
}

TEST(Hdf5File, RefusesATruncatedFileAtAnyLength) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const std::string whole = read_bytes(folder / "a.h5");
  for (const double share : {0.0, 0.001, 0.01, 0.1, 0.5, 0.9, 0.999}) {
    write_bytes(folder / "cut.h5",
                whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    const std::string message = refusal([&] { Hdf5Reader(folder / "cut.h5", "sample", 2); });
    EXPECT_NE(message.find("cut.h5"), std::string::npos) << share;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  write_bytes(folder / "cut.h5", whole.substr(0, whole.size() - 1));
  EXPECT_NE(refusal([&] { Hdf5Reader(folder / "cut.h5", "sample", 2); }).find("truncated"), std::string::npos);
}

TEST(Hdf5File, ChecksumFindsAFlippedBitInTheData) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  std::string bytes = read_bytes(folder / "a.h5");
  int refused = 0;
  for (int k = 1; k <= 8; ++k) {
    std::string damaged = bytes;
    damaged[bytes.size() * static_cast<std::size_t>(k) / 9] ^= 0x10;
    write_bytes(folder / "bad.h5", damaged);
    const std::string message = refusal([&] {
      const Hdf5Reader file(folder / "bad.h5", "sample", 2);
      file.read<double>("deep/er/wave", 3);
    });
    refused += message.empty() ? 0 : 1;
  }
  EXPECT_GE(refused, 6);  // the wave is most of the file; a flip elsewhere may hit unused space
}

TEST(Hdf5File, RefusesWhatIsNotAskedFor) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  write_bytes(folder / "text.h5", "time[s],power[W]\n");
  const auto open = [&](const std::string& name, const std::string& kind, int version) {
    return refusal([&] { Hdf5Reader(folder / name, kind, version); });
  };
  EXPECT_NE(open("missing.h5", "sample", 2).find("no such file"), std::string::npos);
  EXPECT_NE(open("text.h5", "sample", 2).find("not an HDF5 file"), std::string::npos);
  EXPECT_NE(open("a.h5", "checkpoint", 2).find("a Talus sample file; expected a checkpoint file"), std::string::npos);
  EXPECT_NE(open("a.h5", "sample", 1).find("newer Talus"), std::string::npos);

  const Hdf5Reader file(folder / "a.h5", "sample", 2);
  EXPECT_NE(refusal([&] { file.read<double>("absent"); }).find("dataset absent: missing"), std::string::npos);
  EXPECT_NE(refusal([&] { file.read<double>("bytes"); }).find("64-bit floating point"), std::string::npos);
  EXPECT_NE(refusal([&] { file.read<double>("deep/er/wave", 4); }).find("expected 4 columns"), std::string::npos);
  EXPECT_NE(refusal([&] {
              file.read<double>("deep/er/wave", ArrayShape{9, 3});
            }).find("expected 9 rows"),
            std::string::npos);
  EXPECT_NE(refusal([&] { file.read<double>("deep"); }).find("dataset deep"), std::string::npos);
  EXPECT_NE(refusal([&] { file.double_attribute("count"); }).find("attribute count"), std::string::npos);
  EXPECT_NE(refusal([&] { file.string_attribute("tiny"); }).find("expected a string"), std::string::npos);
}

TEST(Hdf5File, SaysWhereItCannotWrite) {
  const TemporaryFolder folder;
  EXPECT_THROW(Hdf5Writer(folder / "no/such/folder.h5", "sample", 1), std::runtime_error);
}

TEST(Hdf5File, BytesDoNotTellTheTimeOfDay) {
  // Groups keep their times to the second: two files of a second apart.
  const TemporaryFolder folder;
  for (const char* name : {"early.h5", "late.h5"}) {
    Hdf5Writer file(folder / name, "test", 1);
    file.write("group/inner/values", std::vector<double>{1, 2, 3});
    file.commit();
    if (name == std::string("early.h5")) std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  }
  EXPECT_EQ(read_bytes(folder / "early.h5"), read_bytes(folder / "late.h5"));
}

}  // namespace
