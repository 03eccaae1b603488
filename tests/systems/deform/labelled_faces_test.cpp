#include "systems/deform/labelled_faces.h"
