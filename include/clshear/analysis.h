/* clshear: analysis of samples: why sheared samples converge faster.
 *
 * Point sets, their spectra, integrands, predicted variance and measured convergence, a header
 * each. The head of common.h describes the common conventions. */
#ifndef CLSHEAR_ANALYSIS_H
#define CLSHEAR_ANALYSIS_H

#include "convergence.h"
#include "integrands.h"
#include "points.h"
#include "prediction.h"
#include "spectrum.h"

#endif
