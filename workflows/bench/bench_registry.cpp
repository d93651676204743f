// SPDX-License-Identifier: Apache-2.0
#include "workflows/bench/bench_registry.h"

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"

namespace workflows {

const std::vector<Bench>& benches() {
  static const std::vector<Bench> all{
      {"box", "200 elastic bodies in a closed room: energy and momentum over 1e5 collisions", plan_box_bench},
      {"bulk", "whole scenes: wall time against error of path, settled height and mill power", plan_bulk_bench},
      {"contact", "single impacts: wall time against error of restitution and contact time", plan_contact_bench},
#ifdef TALUS_BENCH_DECOMPOSITION
      {"decomposition", "convex parts of scans (--scans DIR) and a torus: error, rules, time, front of error and cost",
       plan_decomposition_bench},
      {"digitize",
       "from clouds and micrographs (--scans DIR), virtual scans and tomograms to shapes: errors against truths",
       plan_digitize_bench},
#endif
      {"growth", "time of a particle in a step against bodies, sizes, parts, faces, contacts, triangles and features",
       plan_growth_bench},
      {"impacts", "sphere impacts of Chung & Ooi (2011), tests 1-8, beside exact and published values",
       plan_impacts_bench},
      {"laws", "contact laws: energy round closed paths, cuts into parts, stiffness exponents", plan_laws_bench},
      {"levels", "levels of detail of a catalogue (--catalog FILE): error against the cost of a contact",
       plan_levels_bench},
#ifdef TALUS_BENCH_MICROGRAPHS
      {"micrographs", "outlines of micrographs (--scans DIR) against those drawn by hand; solids made to match them",
       plan_micrographs_bench},
#endif
      {"overlap", "overlap integrals: error against closed forms, time per pair", plan_overlap_bench},
      {"parts", "how many parts a rock needs (--catalog FILE): 300 rocks poured, tilted and emptied at every level",
       plan_parts_bench},
      {"pile", "300 mixed grains settling: speed, energy balance, overlap, threads", plan_pile_bench},
      {"speed", "time of a step on the scenes S1 to S4, contacts, energy, memory, threads, beside LIGGGHTS",
       plan_speed_bench},
      {"walls", "a drum as a cylinder and as 64 and 512 flat segments: torque and work", plan_walls_bench},
      // A new bench: its file beside these, its function in the header, one line here.
  };
  return all;
}

const Bench& bench_named(const std::string& name) {
  std::vector<std::string> known;
  for (const Bench& bench : benches()) {
    if (bench.name == name) return bench;
    known.push_back(bench.name);
  }
  throw catalog::UsageError("no bench '" + name + "'; " + catalog::word_hint(name, known) +
                            " talus bench --list names all");
}

}  // namespace workflows
