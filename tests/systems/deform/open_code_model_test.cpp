#include "systems/deform/open_code_model.h"
