// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include "catalog/input_error.h"
#include "postprocess/run_figures.h"
#include "postprocess/run_folder.h"
#include "postprocess/run_plots.h"
#include "postprocess/run_report.h"
#include "postprocess/vtk_export.h"
#include "workflows/command_options.h"
#include "workflows/picture_process.h"
#include "workflows/stage_tool.h"

namespace {

namespace fs = std::filesystem;
using dem_gpu::Snapshot;
using postprocess::RunFolder;

constexpr const char* kHelp =
    "Example: talus post runs/hopper\n\n"
    "VTK series, pictures, curves and a report from a run folder:\n"
    "  writes runs/hopper/report.html and, in runs/hopper/post, PVD and VTP files for ParaView, PNG and SVG.\n";

struct PostOptions {
  fs::path run;
  bool has_pictures = true;
  int every = 1;
  bool is_report_only = false;
  bool is_json = false;
  bool draws_only = false;  // the child process that has a display
};

PostOptions parse_post_options(int argc, char** argv) {
  PostOptions options;
  CLI::App app(kHelp, "talus post");
  bool no_pictures = false;
  app.add_option("RUN", options.run, "run folder of talus simulate")->required();
  app.add_flag("--no-pictures", no_pictures, "draw no pictures");
  app.add_option("--every", options.every, "VTP files of every N-th snapshot only")->check(CLI::Range(1, 1000000));
  app.add_flag("--report-only", options.is_report_only, "no VTP files: report, curves and pictures");
  app.add_flag("--json", options.is_json, "print the figures as one JSON object on stdout");
  app.add_flag("--draw-pictures", options.draws_only)->group("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(workflows::ended_status(app, error));
  }
  options.has_pictures = !no_pictures;
  return options;
}

std::string number_of(const fs::path& snapshot) {
  return snapshot.stem().string().substr(std::string("snapshot_").size());
}

/// True if `file` was made after every one of `sources`.
bool is_newer(const fs::path& file, const std::vector<fs::path>& sources) {
  std::error_code error;
  const auto made = fs::last_write_time(file, error);
  if (error) return false;
  for (const fs::path& source : sources)
    if (fs::last_write_time(source) >= made) return false;
  return true;
}

std::vector<std::size_t> every_nth(std::size_t count, int every) {
  std::vector<std::size_t> chosen;
  for (std::size_t s = 0; s < count; s += static_cast<std::size_t>(every)) chosen.push_back(s);
  return chosen;
}

/// VTP files of the chosen snapshots, those that are there already left as they are, and a PVD series over them.
void write_vtk_series(const RunFolder& run, const std::vector<std::size_t>& chosen, const std::vector<double>& times,
                      workflows::BatchProgress& progress) {
  using Writer = void (*)(const fs::path&, const dem_gpu::RunGeometry&, const Snapshot&);
  const std::pair<const char*, Writer> kinds[] = {{"bodies", postprocess::write_bodies_vtp},
                                                  {"walls", postprocess::write_walls_vtp},
                                                  {"contacts", postprocess::write_contacts_vtp}};
  std::vector<postprocess::SeriesEntry> entries[3];
  for (const std::size_t s : chosen) {
    const fs::path& source = run.snapshots[s];
    std::optional<Snapshot> snapshot;
    for (int k = 0; k < 3; ++k) {
      const std::string name = std::string(kinds[k].first) + "_" + number_of(source) + ".vtp";
      entries[k].push_back({times[s], name});
      if (is_newer(run.path / "post" / name, {source, run.path / "geometry.h5"})) continue;
      if (!snapshot) snapshot = dem_gpu::read_snapshot(source);
      kinds[k].second(run.path / "post" / name, run.geometry, *snapshot);
    }
    progress.step(source.filename().string());
  }
  for (int k = 0; k < 3; ++k)
    postprocess::write_pvd(run.path / "post" / (std::string(kinds[k].first) + ".pvd"), entries[k]);
}

fs::path picture_file(const RunFolder& run, std::size_t snapshot) {
  return run.path / "post" / ("picture_" + number_of(run.snapshots[snapshot]) + ".png");
}

std::vector<double> snapshot_times(const RunFolder& run) {
  std::vector<double> times;
  for (const fs::path& file : run.snapshots) times.push_back(dem_gpu::read_snapshot_time(file));
  return times;
}

std::vector<Snapshot> read_snapshots(const RunFolder& run, const std::vector<std::size_t>& chosen) {
  std::vector<Snapshot> snapshots;
  for (const std::size_t s : chosen) snapshots.push_back(dem_gpu::read_snapshot(run.snapshots[s]));
  return snapshots;
}

/// In the process that has a display: draws all pictures, with one camera and one colour scale.
int draw_pictures(const RunFolder& run) {
  const std::vector<std::size_t> chosen = postprocess::pictured_snapshots(run, snapshot_times(run));
  const std::vector<Snapshot> snapshots = read_snapshots(run, chosen);
  const postprocess::PictureView view = postprocess::picture_view(run.geometry, snapshots, run.up);
  for (std::size_t k = 0; k < chosen.size(); ++k)
    postprocess::write_text_file(picture_file(run, chosen[k]),
                                 postprocess::picture_png(run.geometry, snapshots[k], view));
  return workflows::kDone;
}

/// Pictures that are there and newer than the run's last snapshot are kept; else all are drawn again, and then those of
/// other snapshots go. Returns why there are none, or nothing.
std::string make_pictures(const RunFolder& run, const std::vector<std::size_t>& chosen) {
  if (chosen.empty()) return "the run has no snapshots";
  std::set<fs::path> wanted;
  bool are_current = true;
  for (const std::size_t s : chosen) {
    wanted.insert(picture_file(run, s));
    are_current = are_current && is_newer(picture_file(run, s), {run.snapshots.back(), run.path / "geometry.h5"});
  }
  if (are_current) return "";
  const std::string failure = workflows::run_with_display({run.path.string(), "--draw-pictures"});
  if (!failure.empty()) return failure;
  std::vector<fs::path> outdated;
  for (const auto& entry : fs::directory_iterator(run.path / "post"))
    if (entry.path().extension() == ".png" && entry.path().filename().string().starts_with("picture_") &&
        !wanted.contains(entry.path()))
      outdated.push_back(entry.path());
  for (const fs::path& file : outdated) fs::remove(file);
  return "";
}

std::string read_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_report(const RunFolder& run, const postprocess::RunFigures& figures, const PostOptions& options,
                  const std::vector<double>& times) {
  const std::vector<std::size_t> pictured = postprocess::pictured_snapshots(run, times);
  postprocess::ReportContents contents;
  contents.no_pictures_because = options.has_pictures ? make_pictures(run, pictured) : "left out by --no-pictures";
  if (contents.no_pictures_because.empty())
    for (const std::size_t s : pictured) contents.pictures.push_back({times[s], read_bytes(picture_file(run, s))});
  else if (options.has_pictures)
    std::fprintf(stderr, "talus post: no pictures: %s\n", contents.no_pictures_because.c_str());
  contents.plots = postprocess::run_plots(run, figures);
  for (const postprocess::NamedPlot& plot : contents.plots)
    postprocess::write_text_file(run.path / "post" / (plot.name + ".svg"), plot.svg);
  contents.frames =
      read_snapshots(run, postprocess::viewer_frames(run.snapshots.size(), run.geometry.body_shape.size()));
  contents.view = postprocess::picture_view(run.geometry, contents.frames, run.up);
  postprocess::write_text_file(run.path / "report.html", postprocess::run_report_html(run, figures, contents));
}

int post(const PostOptions& options) {
  const RunFolder run = postprocess::read_run_folder(options.run);
  if (options.draws_only) return draw_pictures(run);
  if (run.snapshots.empty() && !run.series)
    throw catalog::InputError(run.path.string() + ": neither snapshots nor time_series.csv; the run has not begun");
  fs::create_directories(run.path / "post");
  const std::vector<double> times = snapshot_times(run);
  if (!options.is_report_only) {
    const std::vector<std::size_t> chosen = every_nth(run.snapshots.size(), options.every);
    workflows::BatchProgress progress("post", static_cast<int>(chosen.size()));
    write_vtk_series(run, chosen, times, progress);
    progress.finish();
  }
  std::optional<Snapshot> last;
  if (!run.snapshots.empty()) last = dem_gpu::read_snapshot(run.snapshots.back());
  const postprocess::RunFigures figures = postprocess::run_figures(run, last);
  write_report(run, figures, options, times);
  if (options.is_json)
    std::printf("%s\n", postprocess::figures_json(run, figures).c_str());
  else
    std::printf("%s\n", (run.path / "report.html").c_str());
  return workflows::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  const PostOptions options = parse_post_options(argc, argv);
  return workflows::run_stage("post", [&] { return post(options); });
}
