// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "postprocess/digitizing_report.h"
#include "workflows/cloud_batch.h"
#include "workflows/digitize_batch.h"
#include "workflows/micrograph_batch.h"
#include "workflows/stack_batch.h"
#include "workflows/turntable_batch.h"

namespace workflows {

// The page of a batch that has run: what is in the catalogue now, drawn beside the sources, which are read again. It
// does not tell whether a shape was stored or there already, so that a batch run again gives the same page. Sources
// that cannot be read are named on the page.
postprocess::DigitizingReport report_of(const DigitizeBatch& batch);
postprocess::DigitizingReport report_of(const CloudBatch& batch);
postprocess::DigitizingReport report_of(const StackBatch& batch);
postprocess::DigitizingReport report_of(const MicrographBatch& batch);
postprocess::DigitizingReport report_of(const TurntableBatch& batch);

}  // namespace workflows
