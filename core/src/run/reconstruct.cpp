#include <dsc/cloud/normalize.hpp>
#include <dsc/run/reconstruct.hpp>
