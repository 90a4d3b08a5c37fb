enum { WIDTH = 96, HEIGHT = 64, FRAMES = 4 };

/* Draws a frame of at most WIDTH x HEIGHT in the current context and prints one line. */
void scene(const char *who, int frame, int width, int height);
