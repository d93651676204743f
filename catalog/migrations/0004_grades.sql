-- SPDX-License-Identifier: Apache-2.0
-- Schema 4: shapes have a grade (1 best, 3 worst: catalog/grade.h), which the program sets from the checks of shapes that
-- were there before, and their place in their source, which those lack.

ALTER TABLE shapes ADD COLUMN grade INTEGER NOT NULL DEFAULT 3;
-- 13 float64, not compressed: axes of the shape row by row and its origin in the frame of its source, scale; see
-- catalog/shape_record.h
ALTER TABLE shapes ADD COLUMN source_frame BLOB;

DROP VIEW shape_overview;
CREATE VIEW shape_overview AS
SELECT shapes.id, shapes.name, shapes.grade, shapes.volume * 1e9 AS volume_mm3, meshes.vertex_count, meshes.face_count,
       (SELECT count(*) FROM levels WHERE levels.shape_id = shapes.id) AS level_count,
       (SELECT count(*) FROM checks WHERE checks.shape_id = shapes.id AND NOT passed) AS failed_checks,
       shapes.source_file
FROM shapes JOIN meshes ON meshes.shape_id = shapes.id
ORDER BY shapes.name;
