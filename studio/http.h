#pragma once

#include <httplib.h>

// A macro of <resolv.h>, which the line above brings in, and a name in Eigen.
#undef _res
