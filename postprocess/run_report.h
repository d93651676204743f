// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postprocess/pictures.h"
#include "postprocess/run_figures.h"
#include "postprocess/run_plots.h"

namespace postprocess {

/// What goes into a report besides the run's tables.
struct ReportContents {
  struct Picture {
    double time = 0;  // [s]
    std::string png;  // bytes
  };
  std::vector<Picture> pictures;
  std::string no_pictures_because;        // shown where there are none
  std::vector<NamedPlot> plots;           // as run_plots gives them
  std::vector<dem_gpu::Snapshot> frames;  // for the contact table (first, middle, last of them) and the 3-D view
  PictureView view;                       // the 3-D view's first
};

/// One HTML page complete in itself: style, pictures, curves and an interactive 3-D view (WebGL 2, no network).
std::string run_report_html(const RunFolder& run, const RunFigures& figures, const ReportContents& contents);

/// Picks which of `count` snapshots the 3-D view holds: evenly spread, the last always among them.
std::vector<std::size_t> viewer_frames(std::size_t count, std::size_t bodies);

}  // namespace postprocess
