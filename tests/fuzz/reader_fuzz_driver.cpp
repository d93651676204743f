// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the fuzz target on the seeds and on so many mutations of them: a short stand-in for libFuzzer, the same on every
// machine. reader_fuzz [MUTATIONS [FIRST]]; of one mutation alone the input is kept as fuzz_input.
#include <sys/resource.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/reader_seeds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr rlim_t kMemory = 3ull << 30;  // a file that lies about its size must not take more [bytes]

using Generator = std::mt19937_64;

std::size_t below(Generator& random, std::size_t count) { return static_cast<std::size_t>(random() % count); }

/// What files lie with: counts, signs, ends of lines, numbers that are none.
const std::vector<std::string> kWords{
    "0",  "-1", "1e308", "nan",  "inf", "4294967295", "2147483648", "99999999999",
    "\n", " ",  "\r\n",  "face", "end", "binary",     "list",       std::string(8, '\0')};

std::string mutated(std::string bytes, const std::vector<std::string>& seeds, Generator& random) {
  for (std::size_t change = 1 + below(random, 4); change > 0 && !bytes.empty(); --change) {
    const std::size_t at = below(random, bytes.size());
    switch (below(random, 6)) {
      case 0:
        bytes[at] = static_cast<char>(random() & 255);
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, 1 + below(random, 16));
        break;
      case 3:
        bytes.insert(at, kWords[below(random, kWords.size())]);
        break;
      case 4: {  // a number becomes another
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit == std::string::npos) break;
        const std::size_t end = std::min(bytes.find_first_not_of("0123456789", digit), bytes.size());
        bytes.replace(digit, end - digit, kWords[below(random, 8)]);
        break;
      }
      default: {  // the end of another file
        const std::string& other = seeds[below(random, seeds.size())];
        bytes = bytes.substr(0, at) + other.substr(below(random, other.size()));
      }
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  const long runs = argc > 1 ? std::atol(argv[1]) : 2000;
  const rlimit limit{kMemory, kMemory};
  setrlimit(RLIMIT_AS, &limit);
  const std::vector<std::string> seeds = fuzz::reader_seeds();
  const auto run = [](const std::string& bytes) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  };
  for (const std::string& seed : seeds) run(seed);
  const long first = argc > 2 ? std::atol(argv[2]) : 0;
  for (long k = first; k < first + runs; ++k) {
    Generator random(static_cast<std::uint64_t>(k));
    const std::string& seed = seeds[below(random, seeds.size())];
    const std::size_t body = seed.find('\n') + 1;  // most keep their ending
    const std::string bytes = seed.substr(0, body) + mutated(seed.substr(body), seeds, random);
    if (runs == 1) std::ofstream("fuzz_input", std::ios::binary) << bytes;  // to look at, should it crash
    try {
      run(bytes);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "mutation %ld: %s\n", k, error.what());
      return 1;
    }
  }
  std::printf("%zu seeds and %ld mutations: read, or refused by name\n", seeds.size(), runs);
  return 0;
}
