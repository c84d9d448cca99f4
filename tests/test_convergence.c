/* The convergence regression: the reason this program exists. */
#include "support.h"
#include <math.h>
int main(void) { return 0; }
