/* The bark of maple.l, and from where to look at it */
texture: F: oak.bark
line style: cylinder
viewpoint: 5,2,8.7
projection: perspective
viewing angle: 24
