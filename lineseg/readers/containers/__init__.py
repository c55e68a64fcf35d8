"""What a recording may be inside of: compressed files, archives, folders."""
