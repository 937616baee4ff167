/* The bark of maple.l */
texture: F: oak.bark
line style: cylinder
