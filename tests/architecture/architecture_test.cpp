// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/architecture/include_rules.h"

namespace {

using namespace architecture;

TEST(Architecture, SourcesKeepToTheArrows) {
  const SourceTree tree = read_modules(TALUS_SOURCE_DIR);
  ASSERT_TRUE(tree.contains("catalog/shape_record.h")) << "sources were not found in " << TALUS_SOURCE_DIR;
  std::size_t includes = 0;
  for (const auto& [file, text] : tree) includes += includes_of(text).size();
  EXPECT_GT(includes, 50u) << "includes were not recognised";
  for (const std::string& violation : violations(tree)) ADD_FAILURE() << violation;
}

// Which tests/backend/CMakeLists.txt gives to nvcc, beside a test that holds device columns. Others take what they need
// from headers without kernels.
TEST(Architecture, OnlyTheTestOfLaunchesSeesKernels) {
  SourceTree tree = read_modules(TALUS_SOURCE_DIR);
  tree.merge(read_tests(TALUS_SOURCE_DIR));
  ASSERT_TRUE(tree.contains("dem_gpu/core/parallel.h"));
  EXPECT_EQ(sources_with_kernels(tree), std::vector<std::string>{"tests/backend/parallel_test.cpp"});
}

/// A small tree that keeps the rules, with the headers that the cases below include.
SourceTree sound_tree() {
  return {
      {"catalog/shape_record.h", "#include <string>\n#include \"catalog/triangle_mesh.h\"\n"},
      {"catalog/triangle_mesh.h", "#include <vector>\n"},
      {"catalog/shape_catalog.h", "#include \"catalog/shape_record.h\"\n"},
      {"catalog/sqlite/database.h", "#include <sqlite3.h>\n"},
      {"catalog/shape_catalog.cpp", "#include \"catalog/sqlite/database.h\"\n#include \"catalog/shape_catalog.h\"\n"},
      {"shape_pipeline/mesh_file.h", "#include <Eigen/Core>\n#include \"catalog/shape_catalog.h\"\n"},
      {"shape_pipeline/mesh_file.cpp", "#include <assimp/scene.h>\n#include <pcl/point_types.h>\n"},
      {"shape_pipeline/detail/hull.h", ""},
      {"decomposition/convex_decomposition.h", "#include \"catalog/convex_part.h\"\n"},
      {"decomposition/split.cpp", "#include <CGAL/convex_hull_3.h>\n"},
      {"catalog/convex_part.h", ""},
      {"dem_gpu/scene.h", "#include \"catalog/convex_part.h\"\n#include \"dem_gpu/core/vec3.h\"\n"},
      {"dem_gpu/snapshot.h", ""},
      {"dem_gpu/simulation.h", "#include \"dem_gpu/scene.h\"\n"},
      {"dem_gpu/core/vec3.h", ""},
      {"dem_gpu/core/parallel.h", "#include <thrust/sort.h>\n"},
      {"dem_gpu/io/file.cpp", "#include <hdf5.h>\n"},
      {"postprocess/vtk_export.h", "#include \"dem_gpu/snapshot.h\"\n#include \"catalog/shape_catalog.h\"\n"},
      {"postprocess/vtk_export.cpp", "#include <vtkCellArray.h>\n"},
      {"tests/benchmark/scenes/speed_scenes.h", "#include \"dem_gpu/scene.h\"\n"},
      {"workflows/stage_tool.h", ""},
      {"workflows/run.cpp",
       "#include <unistd.h>\n#include <sys/wait.h>\n#include <CLI/CLI.hpp>\n#include <toml++/toml.h>\n"
       "#include \"workflows/stage_tool.h\"\n#include \"dem_gpu/simulation.h\"\n#include "
       "\"postprocess/vtk_export.h\"\n#include \"tests/benchmark/scenes/speed_scenes.h\"\n"},
  };
}

TEST(ArchitectureRules, AcceptASoundTree) { EXPECT_EQ(violations(sound_tree()), std::vector<std::string>{}); }

struct BadInclude {
  const char* file;
  const char* line;
  const char* expected;  // part of the message
};

// Each case appended to the sound tree must give one violation that names its file and line.
TEST(ArchitectureRules, RefuseEachBadArrow) {
  const BadInclude cases[] = {
      // Arrows that do not exist.
      {"catalog/new.cpp", "#include \"dem_gpu/scene.h\"", "catalog may not include dem_gpu"},
      {"catalog/new.h", "#include \"workflows/stage_tool.h\"", "catalog may not include workflows"},
      {"shape_pipeline/new.cpp", "#include \"decomposition/convex_decomposition.h\"", "may not include decomposition"},
      {"decomposition/new.cpp", "#include \"shape_pipeline/mesh_file.h\"", "may not include shape_pipeline"},
      {"decomposition/new.cpp", "#include \"dem_gpu/scene.h\"", "may not include dem_gpu"},
      {"dem_gpu/core/new.h", "#include \"postprocess/vtk_export.h\"", "may not include postprocess"},
      {"dem_gpu/new.cpp", "#include \"decomposition/convex_decomposition.h\"", "may not include decomposition"},
      {"postprocess/new.cpp", "#include \"shape_pipeline/mesh_file.h\"", "may not include shape_pipeline"},
      {"postprocess/new.cpp", "#include \"workflows/stage_tool.h\"", "may not include workflows"},
      {"dem_gpu/new.cpp", "#include \"tests/benchmark/scenes/speed_scenes.h\"", "may not include benchmark_scenes"},
      {"tests/benchmark/scenes/new.cpp", "#include \"workflows/stage_tool.h\"", "may not include workflows"},
      // Arrows to types only.
      {"dem_gpu/new.cpp", "#include \"catalog/shape_catalog.h\"", "only the types of catalog"},
      {"postprocess/new.cpp", "#include \"dem_gpu/simulation.h\"", "only the types of dem_gpu"},
      // Private folders.
      {"postprocess/new.cpp", "#include \"dem_gpu/core/vec3.h\"", "private to dem_gpu"},
      {"workflows/new.cpp", "#include \"catalog/sqlite/database.h\"", "private to catalog"},
      {"workflows/new.cpp", "#include \"shape_pipeline/detail/hull.h\"", "private to shape_pipeline"},
      // Libraries out of their place.
      {"shape_pipeline/new.h", "#include <CGAL/Surface_mesh.h>", "CGAL"},
      {"shape_pipeline/detail/new.h", "#include <pcl/point_cloud.h>", "PCL"},
      {"decomposition/new.cpp", "#include <pcl/point_cloud.h>", "PCL"},
      {"decomposition/new.cpp", "#include <assimp/scene.h>", "assimp"},
      {"postprocess/new.cpp", "#include <opencv2/core.hpp>", "OpenCV"},
      {"dem_gpu/new.cpp", "#include <CGAL/Surface_mesh.h>", "CGAL"},
      {"postprocess/new.h", "#include <vtkCellArray.h>", "VTK"},
      {"workflows/new.cpp", "#include <vtkCellArray.h>", "VTK"},
      {"dem_gpu/new.cpp", "#include <sqlite3.h>", "SQLite"},
      {"workflows/new.cpp", "#include <sqlite3.h>", "SQLite"},
      {"dem_gpu/contacts/new.cpp", "#include <thrust/sort.h>", "Thrust"},
      {"dem_gpu/broad_phase/new.h", "#include <cub/cub.cuh>", "Thrust"},
      {"workflows/new.h", "#include <CLI/CLI.hpp>", "CLI11"},
      {"catalog/new.cpp", "#include <CLI/CLI.hpp>", "CLI11"},
      {"dem_gpu/io/new.h", "#include <hdf5.h>", "HDF5"},
      {"postprocess/new.cpp", "#include <H5Cpp.h>", "HDF5"},
      {"postprocess/plots/new.h", "#include <vtkPolyData.h>", "VTK"},
      {"dem_gpu/new.cpp", "#include <toml++/toml.h>", "toml++"},
      {"dem_gpu/io/new.cpp", "#include <nlohmann/json.hpp>", "nlohmann-json"},
      {"postprocess/new.h", "#include <nlohmann/json.hpp>", "nlohmann-json"},
      {"dem_gpu/bodies/new.h", "#include <tbb/parallel_for.h>", "TBB"},
      {"dem_gpu/new.cpp", "#include <omp.h>", "OpenMP"},
      {"catalog/new.cpp", "#include <Eigen/Dense>", "Eigen"},
      {"catalog/new.cpp", "#include <fmt/format.h>", "no library that the rules know"},
      {"catalog/new.cpp", "#include <lzma.h>", "no library that the rules know"},
      // Spelling.
      {"dem_gpu/core/new.h", "#include \"vec3.h\"", "written from the repository root"},
      {"dem_gpu/core/new.h", "#include \"../scene.h\"", "written from the repository root"},
      {"catalog/new.cpp", "#include \"tests/support/sample_shapes.h\"", "written from the repository root"},
      {"catalog/new.cpp", "#include \"catalog/missing.h\"", "written from the repository root"},
      {"catalog/new.cpp", "#include <catalog/shape_record.h>", "stands in quotes"},
      {"catalog/new.cpp", "  #  include   \"dem_gpu/scene.h\"  // spaces", "catalog may not include dem_gpu"},
  };
  for (const BadInclude& bad : cases) {
    SourceTree tree = sound_tree();
    tree[bad.file] = std::string("// first line\n") + bad.line + "\n";
    const std::vector<std::string> found = violations(tree);
    const std::string place = std::string(bad.file) + ":2: ";
    const bool is_named = std::any_of(found.begin(), found.end(), [&](const std::string& violation) {
      return violation.starts_with(place) && violation.find(bad.expected) != std::string::npos;
    });
    EXPECT_TRUE(is_named) << bad.file << " with " << bad.line << " gave "
                          << (found.empty() ? "nothing" : found.front());
  }
}

TEST(ArchitectureRules, PublicHeadersPullInNoLibraryThroughAnother) {
  SourceTree tree = sound_tree();
  tree["dem_gpu/simulation.h"] = "#include \"dem_gpu/core/columns.h\"\n";
  tree["dem_gpu/core/columns.h"] = "#include \"dem_gpu/core/parallel.h\"\n";
  const std::vector<std::string> found = violations(tree);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].starts_with("dem_gpu/simulation.h:1: ")) << found[0];
  EXPECT_NE(found[0].find("Thrust"), std::string::npos);
}

TEST(ArchitectureRules, AKernelIsSeenThroughHeaders) {
  SourceTree tree = sound_tree();
  tree["dem_gpu/contacts/kernel.h"] = "#include \"dem_gpu/core/parallel.h\"\n";
  tree["dem_gpu/contacts/pairs.cpp"] = "#include \"dem_gpu/contacts/kernel.h\"\n";
  EXPECT_EQ(sources_with_kernels(tree), std::vector<std::string>{});
  tree["tests/unit/pairs_test.cpp"] = "#include \"dem_gpu/contacts/kernel.h\"\n";
  EXPECT_EQ(sources_with_kernels(tree), std::vector<std::string>{"tests/unit/pairs_test.cpp"});
}

TEST(IncludeReader, LeavesCommentsOutAndCountsLines) {
  const std::vector<Include> found = includes_of(
      "// #include <a>\n#include <b> /* starts\n#include <c>\nends */ #define X\n  # include \"d/e.h\" // why\n"
      "/* one line */\n#include <f>\n");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].path, "b");
  EXPECT_EQ(found[0].line, 2);
  EXPECT_EQ(found[1].path, "d/e.h");
  EXPECT_TRUE(found[1].is_quoted);
  EXPECT_EQ(found[1].line, 5);
  EXPECT_EQ(found[2].path, "f");
  EXPECT_EQ(found[2].line, 7);
}

}  // namespace
