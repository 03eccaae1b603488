#include "tests/cli/pipeline.h"
