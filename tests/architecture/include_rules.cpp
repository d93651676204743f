// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

namespace architecture {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const Names kModules{"catalog",     "shape_pipeline", "decomposition",   "dem_gpu",
                     "postprocess", "workflows",      "benchmark_scenes"};

/// The one module that does not stand in the root: scenes that are measured, by benches and by tests.
constexpr char kSceneFolder[] = "tests/benchmark/scenes/";

// The part of a module's public headers that hold types only: no database, no engine.
const Names kCatalogTypes{"input_error.h",     "triangle_mesh.h", "convex_part.h", "fit_mode.h",
                          "mass_properties.h", "shape_record.h",  "nearest_word.h"};
const Names kEngineTypes{"scene.h", "snapshot.h"};

struct Arrow {
  const char* from;
  const char* to;
  const Names* headers;  // null: every public header
};
const Arrow kArrows[] = {
    {"shape_pipeline", "catalog", nullptr},
    {"decomposition", "catalog", nullptr},
    {"dem_gpu", "catalog", &kCatalogTypes},
    {"postprocess", "catalog", nullptr},
    {"postprocess", "dem_gpu", &kEngineTypes},
    {"workflows", "catalog", nullptr},
    {"workflows", "shape_pipeline", nullptr},
    {"workflows", "decomposition", nullptr},
    {"workflows", "dem_gpu", nullptr},
    {"workflows", "postprocess", nullptr},
    {"workflows", "benchmark_scenes", nullptr},
    {"benchmark_scenes", "dem_gpu", nullptr},
    {"benchmark_scenes", "catalog", &kCatalogTypes},
};

/// Where a library may be included: files whose path matches. A public header may pull in Eigen alone, which is looked
/// at apart; the headers of workflows are private, but CLI11 is too slow to compile for any of them.
struct Library {
  const char* name;
  const char* include;  // regular expression over what stands between < and >
  const char* allowed;  // regular expression over the including file's path
};
const Library kLibraries[] = {
    {"PCL", "pcl/.*", "shape_pipeline/.*\\.cpp"},
    {"OpenCV", "opencv2/.*", "shape_pipeline/.*\\.cpp"},
    {"assimp", "assimp/.*", "shape_pipeline/.*\\.cpp"},
    {"CGAL", "CGAL/.*", "(shape_pipeline|decomposition)/.*\\.cpp"},
    {"Boost", "boost/.*", "(shape_pipeline|decomposition)/.*\\.cpp"},
    {"TBB", "(oneapi/)?tbb/.*", "(shape_pipeline|decomposition|workflows)/.*\\.cpp|dem_gpu/core/.*"},
    {"vector instructions", "immintrin\\.h", "dem_gpu/core/.*"},
    {"OpenMP", "omp\\.h", "workflows/.*\\.cpp|dem_gpu/core/.*"},
    {"VTK", "vtk[A-Za-z0-9_]*\\.h", "postprocess/.*\\.cpp"},
    {"SQLite", "sqlite3\\.h", "catalog/.*\\.cpp|catalog/.+/.*\\.h"},
    {"zlib", "zlib\\.h", "(catalog|postprocess|shape_pipeline)/.*\\.cpp"},
    {"libtiff", "tiffio\\.h", "shape_pipeline/.*\\.cpp"},
    {"Thrust, CUB or CUDA", "(thrust|cub|cuda)/.*|cuda.*\\.h|nvtx.*", "dem_gpu/core/.*"},
    {"the compiler's vector registers", "immintrin\\.h", "dem_gpu/core/.*"},
    {"HDF5", "(hdf5|H5[A-Za-z]*)\\.h", "dem_gpu/.*\\.cpp"},
    {"CLI11", "CLI/.*", "workflows/.*\\.cpp"},
    {"toml++", "toml\\+\\+/.*", "workflows/.*"},
    {"nlohmann-json", "nlohmann/.*", "(postprocess|shape_pipeline|decomposition)/.*\\.cpp|workflows/.*"},
    {"Eigen", "(unsupported/)?Eigen/.*", "(shape_pipeline|decomposition|dem_gpu|postprocess|workflows)/.*"},
};

/// C++ headers have no dot and no folder; of the C and POSIX ones, those that make sense here.
bool is_standard(const std::string& include) {
  static const std::regex cpp("[a-z0-9_]+"), posix("sys/[a-z]+\\.h|[a-z]+\\.h");
  static const Names c_and_posix{"unistd.h", "fcntl.h",  "signal.h", "errno.h",   "stdlib.h",  "stdio.h",  "string.h",
                                 "math.h",   "time.h",   "dlfcn.h",  "termios.h", "spawn.h",   "poll.h",   "limits.h",
                                 "stdint.h", "stddef.h", "fenv.h",   "pthread.h", "strings.h", "libgen.h", "malloc.h"};
  if (std::regex_match(include, cpp)) return true;
  return std::regex_match(include, posix) && (include.starts_with("sys/") || c_and_posix.contains(include));
}

const Library* library_of(const std::string& include) {
  const auto found = std::find_if(std::begin(kLibraries), std::end(kLibraries), [&](const Library& library) {
    return std::regex_match(include, std::regex(library.include));
  });
  return found == std::end(kLibraries) ? nullptr : found;
}

bool is_header(const std::string& file) {
  return file.ends_with(".h") || file.ends_with(".hpp") || file.ends_with(".cuh");
}
std::string module_of(const std::string& file) {
  return file.starts_with(kSceneFolder) ? "benchmark_scenes" : file.substr(0, file.find('/'));
}
std::string inside_module(const std::string& file) {
  if (file.starts_with(kSceneFolder)) return file.substr(sizeof kSceneFolder - 1);
  return file.substr(std::min(file.size(), file.find('/') + 1));
}
bool is_public(const std::string& file) {
  return is_header(file) && inside_module(file).find('/') == std::string::npos && module_of(file) != "workflows";
}

/// Empty, or what is wrong with a quoted include.
std::string arrow_fault(const SourceTree& tree, const std::string& file, const std::string& target) {
  const std::string from = module_of(file), to = module_of(target);
  if (!kModules.contains(to) || !tree.contains(target))
    return "\"" + target + "\" is no file of a module; includes are written from the repository root";
  if (from == to) return "";
  const auto arrow = std::find_if(std::begin(kArrows), std::end(kArrows),
                                  [&](const Arrow& a) { return a.from == from && a.to == to; });
  if (arrow == std::end(kArrows)) return from + " may not include " + to + " (\"" + target + "\")";
  if (!is_public(target)) return "\"" + target + "\" is private to " + to;
  if (arrow->headers && !arrow->headers->contains(inside_module(target)))
    return from + " may include only the types of " + to + ", not \"" + target + "\"";
  return "";
}

/// Empty, or what is wrong with an include in angle brackets.
std::string library_fault(const std::string& file, const std::string& include) {
  if (is_standard(include)) return "";
  if (kModules.contains(module_of(include)) && include.find('/') != std::string::npos)
    return "<" + include + "> is ours and stands in quotes";
  const Library* library = library_of(include);
  if (!library) return "<" + include + "> is of no library that the rules know";
  if (!std::regex_match(file, std::regex(library->allowed)))
    return std::string(library->name) + " (<" + include + ">) is allowed only in " + library->allowed;
  return "";
}

/// Our files that a file reaches through its quoted includes, itself among them, and the libraries but Eigen that they
/// include.
void follow(const SourceTree& tree, const std::string& file, Names& seen, Names& libraries) {
  if (!tree.contains(file) || !seen.insert(file).second) return;
  for (const Include& include : includes_of(tree.at(file))) {
    if (include.is_quoted)
      follow(tree, include.path, seen, libraries);
    else if (const Library* library = library_of(include.path); library && library->name != std::string("Eigen"))
      libraries.insert(library->name);
  }
}

void read_folder(const fs::path& root, const fs::path& folder, SourceTree& tree) {
  static const Names extensions{".h", ".hpp", ".cuh", ".cpp", ".cc", ".cu"};
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (!entry.is_regular_file() || !extensions.contains(entry.path().extension().string())) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    tree[fs::relative(entry.path(), root).generic_string()] = {std::istreambuf_iterator<char>(file), {}};
  }
}

}  // namespace

SourceTree read_modules(const fs::path& root) {
  SourceTree tree;
  for (const std::string& module : kModules)
    read_folder(root, module == "benchmark_scenes" ? fs::path(kSceneFolder) : fs::path(module), tree);
  return tree;
}

SourceTree read_tests(const fs::path& root) {
  SourceTree tree;
  read_folder(root, "tests", tree);
  return tree;
}

std::vector<Include> includes_of(const std::string& text) {
  static const std::regex directive(R"re(^\s*#\s*(include|include_next|import)\s*([<"])([^>"]+)[>"])re");
  std::vector<Include> includes;
  std::istringstream lines(text);
  std::string line;
  bool in_comment = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (in_comment) {
      const std::size_t end = line.find("*/");
      if (end == std::string::npos) continue;
      line.erase(0, end + 2);
      in_comment = false;
    }
    std::smatch match;
    if (std::regex_search(line, match, directive)) {
      includes.push_back({number, match[3], match[2] == "\""});
      line = match.suffix();
    }
    const std::size_t start = line.find("/*"), slashes = line.find("//");
    if (start != std::string::npos && start < slashes) in_comment = line.find("*/", start + 2) == std::string::npos;
  }
  return includes;
}

std::vector<std::string> violations(const SourceTree& tree) {
  std::vector<std::string> list;
  for (const auto& [file, text] : tree) {
    for (const Include& include : includes_of(text)) {
      const std::string fault =
          include.is_quoted ? arrow_fault(tree, file, include.path) : library_fault(file, include.path);
      if (!fault.empty()) list.push_back(file + ":" + std::to_string(include.line) + ": " + fault);
    }
    if (!is_public(file)) continue;
    Names seen, libraries;
    follow(tree, file, seen, libraries);
    for (const std::string& library : libraries)
      list.push_back(file + ":1: a public header must not pull in " + library + ", not even through another header");
  }
  return list;
}

std::vector<std::string> sources_with_kernels(const SourceTree& tree) {
  std::vector<std::string> list;
  for (const auto& [file, text] : tree) {
    if (is_header(file) || module_of(file) == "dem_gpu") continue;
    Names seen, libraries;
    follow(tree, file, seen, libraries);
    if (seen.contains("dem_gpu/core/parallel.h")) list.push_back(file);
  }
  return list;
}

}  // namespace architecture
