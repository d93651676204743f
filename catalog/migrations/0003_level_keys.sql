-- SPDX-License-Identifier: Apache-2.0
-- Schema 3: levels are told apart by mode and face cap too, and carry more errors (NULL where they were not measured).
-- Before, a level's mode and face cap stood in its options alone; where they do not, it is volume-true without a cap.
-- A table's UNIQUE cannot be altered, and dropping `levels` would drop its parts with it: both are made anew.

DROP VIEW shape_overview;
DROP VIEW level_overview;

CREATE TEMP TABLE kept_levels AS SELECT * FROM levels;
CREATE TEMP TABLE kept_parts AS SELECT * FROM parts;
DROP TABLE parts;
DROP TABLE levels;

-- One row per level of detail: a partition of the shape into convex parts, with its measured errors. Distances of
-- surfaces over the diagonal of the mesh's bounding box: from points of the mesh to the union, from points of the union
-- to the mesh, and of both together. mode is volume-true, enclosing or inscribed; face_cap is 0 where there is none.
CREATE TABLE levels (
  id INTEGER PRIMARY KEY,
  shape_id INTEGER NOT NULL REFERENCES shapes (id) ON DELETE CASCADE,
  parts_asked INTEGER NOT NULL,
  vertex_cap INTEGER NOT NULL,
  face_cap INTEGER NOT NULL,
  mode TEXT NOT NULL,
  part_count INTEGER NOT NULL,
  volume REAL,
  centroid_x REAL, centroid_y REAL, centroid_z REAL,
  principal_inertia_1 REAL, principal_inertia_2 REAL, principal_inertia_3 REAL,
  mass_properties BLOB NOT NULL,
  symmetric_difference REAL,
  method_error REAL,
  missing_volume REAL,
  volume_error REAL,
  overlap REAL,
  surface_from_mesh_mean REAL, surface_from_mesh_95 REAL, surface_from_mesh_max REAL,
  surface_from_union_mean REAL, surface_from_union_95 REAL, surface_from_union_max REAL,
  surface_mean REAL, surface_95 REAL, surface_max REAL,
  centre_error REAL,
  inertia_error REAL,
  convexity_error REAL,
  source_file TEXT NOT NULL,
  source_sha256 TEXT NOT NULL,
  tool_version TEXT NOT NULL,
  options TEXT NOT NULL,
  UNIQUE (shape_id, parts_asked, vertex_cap, face_cap, mode)
);

INSERT INTO levels (id, shape_id, parts_asked, vertex_cap, face_cap, mode, part_count, volume, centroid_x, centroid_y,
                    centroid_z, principal_inertia_1, principal_inertia_2, principal_inertia_3, mass_properties,
                    symmetric_difference, method_error, missing_volume, volume_error, overlap, surface_mean,
                    surface_max, source_file, source_sha256, tool_version, options)
SELECT id, shape_id, parts_asked, vertex_cap,
       CASE WHEN json_valid(options) AND json_type(options, '$.options.face_cap') = 'integer'
            THEN json_extract(options, '$.options.face_cap') ELSE 0 END,
       CASE WHEN json_valid(options) AND json_extract(options, '$.options.mode') IN ('enclosing', 'inscribed')
            THEN json_extract(options, '$.options.mode') ELSE 'volume-true' END,
       part_count, volume, centroid_x, centroid_y, centroid_z, principal_inertia_1, principal_inertia_2,
       principal_inertia_3, mass_properties, symmetric_difference, method_error, missing_volume, volume_error, overlap,
       surface_mean, surface_max, source_file, source_sha256, tool_version, options
FROM kept_levels;

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
INSERT INTO parts SELECT * FROM kept_parts;
DROP TABLE kept_levels;
DROP TABLE kept_parts;

CREATE VIEW shape_overview AS
SELECT shapes.id, shapes.name, shapes.volume * 1e9 AS volume_mm3, meshes.vertex_count, meshes.face_count,
       (SELECT count(*) FROM levels WHERE levels.shape_id = shapes.id) AS level_count,
       (SELECT count(*) FROM checks WHERE checks.shape_id = shapes.id AND NOT passed) AS failed_checks,
       shapes.source_file
FROM shapes JOIN meshes ON meshes.shape_id = shapes.id
ORDER BY shapes.name;

CREATE VIEW level_overview AS
SELECT shapes.name, levels.mode, levels.parts_asked, levels.vertex_cap, levels.face_cap, levels.part_count,
       levels.symmetric_difference, levels.missing_volume, levels.volume_error, levels.surface_mean, levels.surface_95,
       levels.surface_max, levels.centre_error, levels.inertia_error, levels.convexity_error, levels.overlap
FROM levels JOIN shapes ON shapes.id = levels.shape_id
ORDER BY shapes.name, levels.mode DESC, levels.parts_asked, levels.vertex_cap, levels.face_cap;
