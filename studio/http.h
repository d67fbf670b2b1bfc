#pragma once

#include <httplib.h>

// A macro of <resolv.h>, included by the line above; also a name in Eigen.
#undef _res
