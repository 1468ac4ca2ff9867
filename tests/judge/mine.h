#pragma once
#if MINE
#define MINE_OR_NOT(x) (x)
#endif
