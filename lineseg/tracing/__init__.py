"""The decisions of a method, and how its kernels log them."""
