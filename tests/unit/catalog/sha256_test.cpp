// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "catalog/input_error.h"
#include "catalog/shape_catalog.h"
#include "tests/support/temporary_folder.h"

namespace {

using catalog::sha256;

std::string hash(const std::string& text) { return sha256(text.data(), text.size()); }

// NIST's examples for FIPS 180-4.
TEST(Sha256, StandardVectors) {
  EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnop"
                 "qrstnopqrstu"),
            "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(hash(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// Lengths around the block of 64 bytes, where the padding takes one block or two.
TEST(Sha256, PaddingAtBlockEdges) {
  EXPECT_EQ(hash(std::string(55, 'a')), "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  EXPECT_EQ(hash(std::string(56, 'a')), "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a");
  EXPECT_EQ(hash(std::string(64, 'a')), "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
}

TEST(Sha256, FileIsHashedInPieces) {
  const test_support::TemporaryFolder folder;
  const std::string text(200001, 'x');  // several read buffers and a remainder
  std::ofstream(folder / "scan.ply", std::ios::binary) << text;
  EXPECT_EQ(catalog::sha256_of_file(folder / "scan.ply"), hash(text));
  std::ofstream(folder / "empty.ply");
  EXPECT_EQ(catalog::sha256_of_file(folder / "empty.ply"), hash(""));
  EXPECT_THROW(catalog::sha256_of_file(folder / "missing.ply"), catalog::InputError);
  EXPECT_THROW(catalog::sha256_of_file(folder.path()), catalog::InputError);
}

}  // namespace
