-- SPDX-License-Identifier: Apache-2.0
-- Talus shape catalogue, schema 1. Lengths in metres, volumes in m3, inertia at density 1 kg/m3 in m5.
-- Blobs of meshes and parts are zlib streams of little-endian numbers; sha256 columns are of the bytes before compression.
-- Rows hold no times: the same input stored in the same order gives the same file.

CREATE TABLE shapes (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  volume REAL,
  centroid_x REAL, centroid_y REAL, centroid_z REAL,
  principal_inertia_1 REAL, principal_inertia_2 REAL, principal_inertia_3 REAL,
  -- the same figures to the last bit, and the axes: 16 float64, not compressed: volume, centroid, inertia, axes row by row
  mass_properties BLOB NOT NULL,
  source_file TEXT NOT NULL,
  source_sha256 TEXT NOT NULL,
  tool_version TEXT NOT NULL,
  options TEXT NOT NULL
);

-- vertices: vertex_count x 3 float64; faces: face_count x 3 int32; sha256 of vertices followed by faces
CREATE TABLE meshes (
  shape_id INTEGER PRIMARY KEY REFERENCES shapes (id) ON DELETE CASCADE,
  vertex_count INTEGER NOT NULL,
  face_count INTEGER NOT NULL,
  vertices BLOB NOT NULL,
  faces BLOB NOT NULL,
  sha256 TEXT NOT NULL
);

-- value is NULL where the figure is not a number
CREATE TABLE descriptors (
  shape_id INTEGER NOT NULL REFERENCES shapes (id) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value REAL,
  PRIMARY KEY (shape_id, name)
) WITHOUT ROWID;

CREATE TABLE checks (
  shape_id INTEGER NOT NULL REFERENCES shapes (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  name TEXT NOT NULL,
  passed INTEGER NOT NULL,
  figure REAL,
  detail TEXT NOT NULL,
  PRIMARY KEY (shape_id, position)
) WITHOUT ROWID;

-- One row per level of detail: a partition of the shape into convex parts, with its measured errors.
CREATE TABLE levels (
  id INTEGER PRIMARY KEY,
  shape_id INTEGER NOT NULL REFERENCES shapes (id) ON DELETE CASCADE,
  parts_asked INTEGER NOT NULL,
  vertex_cap INTEGER NOT NULL,
  part_count INTEGER NOT NULL,
  volume REAL,
  centroid_x REAL, centroid_y REAL, centroid_z REAL,
  principal_inertia_1 REAL, principal_inertia_2 REAL, principal_inertia_3 REAL,
  mass_properties BLOB NOT NULL,
  symmetric_difference REAL,
  missing_volume REAL,
  volume_error REAL,
  surface_mean REAL,
  surface_max REAL,
  overlap REAL,
  method_error REAL,
  source_file TEXT NOT NULL,
  source_sha256 TEXT NOT NULL,
  tool_version TEXT NOT NULL,
  options TEXT NOT NULL,
  UNIQUE (shape_id, parts_asked, vertex_cap)
);

-- encoding: int32 vertex_count, int32 face_count, vertices x 3 float64, then each face: int32 kind (0 outer, 1 inner),
-- int32 corner_count, plane normal 3 float64, plane offset float64, corners int32
CREATE TABLE parts (
  level_id INTEGER NOT NULL REFERENCES levels (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  vertex_count INTEGER NOT NULL,
  face_count INTEGER NOT NULL,
  encoding BLOB NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY (level_id, position)
);

-- Inputs that could not be used, with the reason; storing a shape of that name takes the row away.
CREATE TABLE rejected (
  name TEXT PRIMARY KEY NOT NULL,
  source_file TEXT NOT NULL,
  source_sha256 TEXT NOT NULL,
  reason TEXT NOT NULL
) WITHOUT ROWID;
