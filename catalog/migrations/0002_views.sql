-- SPDX-License-Identifier: Apache-2.0
-- Schema 2: views for reading by eye; the view wide_descriptors (a column for each descriptor) is made on storing.

CREATE INDEX descriptors_by_name ON descriptors (name, value);

CREATE VIEW shape_overview AS
SELECT shapes.id, shapes.name, shapes.volume * 1e9 AS volume_mm3, meshes.vertex_count, meshes.face_count,
       (SELECT count(*) FROM levels WHERE levels.shape_id = shapes.id) AS level_count,
       (SELECT count(*) FROM checks WHERE checks.shape_id = shapes.id AND NOT passed) AS failed_checks,
       shapes.source_file
FROM shapes JOIN meshes ON meshes.shape_id = shapes.id
ORDER BY shapes.name;

CREATE VIEW level_overview AS
SELECT shapes.name, levels.parts_asked, levels.vertex_cap, levels.part_count, levels.symmetric_difference,
       levels.missing_volume, levels.volume_error, levels.surface_mean, levels.surface_max, levels.overlap
FROM levels JOIN shapes ON shapes.id = levels.shape_id
ORDER BY shapes.name, levels.parts_asked, levels.vertex_cap;

CREATE VIEW failed_checks AS
SELECT shapes.name AS shape, checks.name, checks.figure, checks.detail
FROM checks JOIN shapes ON shapes.id = checks.shape_id
WHERE NOT checks.passed
ORDER BY shapes.name, checks.position;
