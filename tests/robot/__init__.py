"""What a robot is: descriptions, tables, chains, poses."""
