"""What a method decided, and how its kernels write that down."""
